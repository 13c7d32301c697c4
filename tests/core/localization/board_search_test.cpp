// SPDX-License-Identifier: GPL-3.0-or-later
#include "localization/board_search.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "support/ordinary_boards.h"
#include "support/pose_matchers.h"
#include "support/simulated_boards.h"

namespace lvcalib {
namespace {

using simulation::LidarKind;
using simulation::SimulatedScene;
using simulation::SimulationOptions;

Eigen::Vector3d board_center(const Target& target, const Rigid3& frame_from_board) {
  const Eigen::Vector2d c = target.outline().center_m();
  return frame_from_board * Eigen::Vector3d(c.x(), c.y(), 0.0);
}

BoardSearchResult search(const SimulatedScene& scene, const Target& target,
                         const BoardSearchOptions& options = {},
                         const std::optional<BoardSearchRegion>& region = std::nullopt,
                         const RunContext& context = {}) {
  const PatternPyramid pyramid(target);
  return search_board(
      scene.cloud,
      {target, pyramid,
       scene.has_board ? board_center(target, scene.camera_from_board).norm() : 3.0, region},
      options, context);
}

// The best candidate is the board; what is found elsewhere (a decoy stands there) hardly counts.
void expect_found(const BoardSearchResult& result, const SimulatedScene& scene,
                  const Target& target) {
  ASSERT_FALSE(result.candidates.empty())
      << result.patches << " patches, best correlation " << result.best_correlation;
  const BoardCandidate& best = result.candidates.front();
  const Eigen::Vector3d truth = board_center(target, scene.lidar_from_board);
  EXPECT_LT((board_center(target, best.lidar_from_board.transform) - truth).norm(), 0.02);
  EXPECT_LT(rotation_distance_rad(best.lidar_from_board.transform, scene.lidar_from_board), 0.03);
  EXPECT_GT(best.correlation, 0.6);
  EXPECT_GT(best.gain, 20.0);
  EXPECT_NEAR(best.scale, 1.0, 0.02);
  for (std::size_t k = 0; k < result.candidates.size(); ++k) {
    const BoardCandidate& c = result.candidates[k];
    EXPECT_LE(c.gain, best.gain);
    if ((board_center(target, c.lidar_from_board.transform) - truth).norm() > 0.5) {
      EXPECT_LT(c.gain, 0.1 * best.gain) << "correlation " << c.correlation;
    }
    ASSERT_LT(c.patch, result.patch_points.size());
  }
  // Its covariance is honest, if generous.
  EXPECT_LT(test::chi_square_of(best.lidar_from_board, scene.lidar_from_board), 25.0);
}

class EveryLidar : public ::testing::TestWithParam<LidarKind> {};

TEST_P(EveryLidar, FindsTheBoardBesideADecoyWithoutAnyGuess) {
  for (const std::uint64_t seed : {11U, 12U, 13U}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const SimulationOptions options = test::cloud_only_options(seed, GetParam());
    const SimulatedScene scene = test::simulated_scene(options, static_cast<int>(seed % 3));
    const auto result = search(scene, options.target);
    expect_found(result, scene, options.target);
    // The points of the winning patch are the board's, at full density.
    if (result.candidates.empty()) continue;
    const Cloud& points = result.patch_points[result.candidates.front().patch];
    const Cloud expected = test::points_about(scene.cloud, options.target, scene.lidar_from_board);
    EXPECT_GT(points.size(), 0.8 * static_cast<double>(expected.size()));
    EXPECT_EQ(points.has_intensity(), true);
  }
}

TEST_P(EveryLidar, FindsABoardPartlyOutOfView) {
  if (GetParam() == LidarKind::kSpinning) GTEST_SKIP() << "its field of view is all around";
  SimulationOptions options = test::cloud_only_options(21, GetParam());
  options.placement.partial = true;
  const SimulatedScene scene = test::simulated_scene(options);
  const auto result = search(scene, options.target);
  ASSERT_FALSE(result.candidates.empty());
  const Rigid3& best = result.candidates.front().lidar_from_board.transform;
  EXPECT_LT(
      (board_center(options.target, best) - board_center(options.target, scene.lidar_from_board))
          .norm(),
      0.03);
}

TEST_P(EveryLidar, FindsNothingWhereThereIsNoBoard) {
  for (const std::uint64_t seed : {31U, 32U}) {
    SimulationOptions options = test::cloud_only_options(seed, GetParam());
    options.placement.board = false;
    const auto result = search(test::simulated_scene(options), options.target);
    EXPECT_TRUE(result.candidates.empty()) << "seed " << seed;
    EXPECT_LT(result.best_correlation, 0.6);
  }
}

// For a first look at a cloud: no camera says how far away to look.
TEST_P(EveryLidar, TheLikelyBoardNeedsNoCamera) {
  SimulationOptions options = test::cloud_only_options(12, GetParam());
  const SimulatedScene scene = test::simulated_scene(options);
  const auto likely = likely_board(scene.cloud, options.target, {});
  ASSERT_TRUE(likely);
  EXPECT_LT(
      (board_center(options.target, *likely) - board_center(options.target, scene.lidar_from_board))
          .norm(),
      0.02);
  options.placement.board = false;
  EXPECT_FALSE(likely_board(test::simulated_scene(options).cloud, options.target, {}));
  std::stop_source stop;
  stop.request_stop();
  RunContext stopped;
  stopped.stop = stop.get_token();
  EXPECT_FALSE(likely_board(scene.cloud, options.target, stopped));
}

// Turned or shifted by a square its colours change places, and markers are small.
TEST_P(EveryLidar, FindsAChArUcoBoardWhicheverWayRound) {
  SimulationOptions options = test::cloud_only_options(31, GetParam());
  options.target = test::charuco_target();
  for (const std::uint64_t seed : {31U, 32U, 33U, 34U}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    options.seed = seed;
    const SimulatedScene scene = test::simulated_scene(options, static_cast<int>(seed % 3));
    const auto result = search(scene, options.target);
    ASSERT_FALSE(result.candidates.empty());
    const BoardCandidate& best = result.candidates.front();
    const Eigen::Vector3d truth = board_center(options.target, scene.lidar_from_board);
    // The stand below it does not tilt it.
    EXPECT_LT((board_center(options.target, best.lidar_from_board.transform) - truth).norm(), 0.01);
    EXPECT_LT(rotation_distance_rad(best.lidar_from_board.transform, scene.lidar_from_board), 0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryLidar,
                         ::testing::Values(LidarKind::kRosette, LidarKind::kAvia,
                                           LidarKind::kSpinning),
                         [](const auto& info) {
                           switch (info.param) {
                             case LidarKind::kRosette:
                               return "Rosette";
                             case LidarKind::kAvia:
                               return "Avia";
                             case LidarKind::kSpinning:
                               break;
                           }
                           return "Spinning";
                         });

TEST(BoardSearch, FindsABoardOnAWallWhenAskedToLookThere) {
  SimulationOptions options = test::cloud_only_options(41, LidarKind::kAvia);
  options.placement.flush_on_wall = true;
  const SimulatedScene scene = test::simulated_scene(options);
  BoardSearchOptions walls;
  walls.search_walls = true;
  const auto result = search(scene, options.target, walls);
  ASSERT_FALSE(result.candidates.empty());
  const Rigid3& best = result.candidates.front().lidar_from_board.transform;
  EXPECT_LT(
      (board_center(options.target, best) - board_center(options.target, scene.lidar_from_board))
          .norm(),
      0.03);
}

TEST(BoardSearch, KeepsToARegion) {
  const SimulationOptions options = test::cloud_only_options(42, LidarKind::kAvia);
  const SimulatedScene scene = test::simulated_scene(options);
  const Eigen::Vector3d center = board_center(options.target, scene.lidar_from_board);
  const auto inside = search(scene, options.target, {}, BoardSearchRegion{center, 1.0});
  expect_found(inside, scene, options.target);
  const Eigen::Vector3d elsewhere = center + Eigen::Vector3d(0.0, 3.0, 0.0);
  EXPECT_TRUE(
      search(scene, options.target, {}, BoardSearchRegion{elsewhere, 1.0}).candidates.empty());
}

TEST(BoardSearch, WithoutIntensityTheOutlineDecides) {
  const SimulationOptions options = test::cloud_only_options(43, LidarKind::kAvia);
  SimulatedScene scene = test::simulated_scene(options);
  scene.cloud.intensity.clear();
  EXPECT_FALSE(matches_by_pattern(options.target, scene.cloud));
  const auto result = search(scene, options.target);
  // A square board in four turns, and the decoy of its size: one of them is right.
  ASSERT_GE(result.candidates.size(), 4U);
  EXPECT_TRUE(std::any_of(result.candidates.begin(), result.candidates.end(), [&](const auto& c) {
    return rotation_distance_rad(c.lidar_from_board.transform, scene.lidar_from_board) < 0.15 &&
           (board_center(options.target, c.lidar_from_board.transform) -
            board_center(options.target, scene.lidar_from_board))
                   .norm() < 0.1;
  }));
}

TEST(BoardSearch, ABoardWithAnotherPrintIsRefused) {
  const SimulationOptions options = test::cloud_only_options(44, LidarKind::kAvia);
  const SimulatedScene scene = test::simulated_scene(options);
  // Same outline, other print.
  Target other = options.target;
  other.tag_columns = 3;
  other.tag_rows = 3;
  other.tag_size_m = 0.16;
  other.circle_radius_m = 0.03;
  const double side = options.target.outline().size_m().x();
  other.margin_m = 0.5 * (side - 2.0 * other.tag_pitch_m() - other.tag_size_m);
  ASSERT_NEAR(other.outline().size_m().x(), side, 1e-9);
  // A chance likeness on other panels is possible, with far less evidence than a board has.
  const Eigen::Vector3d truth = board_center(options.target, scene.lidar_from_board);
  for (const BoardCandidate& c : search(scene, other).candidates) {
    EXPECT_GT((board_center(other, c.lidar_from_board.transform) - truth).norm(), 0.5);
    EXPECT_LT(c.gain, 100.0);
  }
}

TEST(BoardSearch, EmptyAndStoppedGiveNothing) {
  const Target target;
  SimulatedScene scene;
  scene.has_board = false;
  EXPECT_TRUE(search(scene, target).candidates.empty());
  scene = test::simulated_scene(test::cloud_only_options(45, LidarKind::kAvia));
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  EXPECT_TRUE(search(scene, target, {}, std::nullopt, context).candidates.empty());
}

}  // namespace
}  // namespace lvcalib
