// SPDX-License-Identifier: GPL-3.0-or-later
#include "refinement/board_refinement.h"

#include <cmath>
#include <numbers>
#include <set>

#include <Eigen/Cholesky>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/statistics.h"
#include "support/pose_matchers.h"
#include "support/simulated_boards.h"

namespace lvcalib {
namespace {

using simulation::LidarKind;
using ::testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

struct BoardScene {
  Target target;
  Cloud points;
  Rigid3 truth;  // lidar_from_board

  explicit BoardScene(std::uint64_t seed, LidarKind kind = LidarKind::kAvia, int scene = 0) {
    auto simulated = test::simulated_scene(test::cloud_only_options(seed, kind), scene);
    truth = simulated.lidar_from_board;
    points = test::points_about(simulated.cloud, target, truth);
  }
  [[nodiscard]] Rigid3 start(double shift_m = 0.005, double turn_rad = 0.5 * kDegree) const {
    return test::off_by(truth, target, shift_m, turn_rad, 17);
  }
  [[nodiscard]] Result<BoardRefinement> refine(const Rigid3& from,
                                               const RefinementOptions& options = {}) const {
    return refine_board(points, target, from, options, {});
  }
  // In-plane error of a node's centre.
  [[nodiscard]] Eigen::Vector2d error(const BoardRefinement& r, const RefinedNode& node) const {
    return node.center_uv_m -
           r.plane.to_plane(truth * Eigen::Vector3d(node.board_m.x(), node.board_m.y(), 0.0));
  }
};

TEST(BoardRefinement, CentresAreTrueWithinTheirCovariance) {
  std::vector<double> error_mm;
  std::vector<double> normalized;
  std::size_t nodes = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const BoardScene scene(seed, LidarKind::kAvia, static_cast<int>(seed % 3));
    const auto refined = scene.refine(scene.start());
    ASSERT_TRUE(refined.ok()) << refined.error().text();
    EXPECT_TRUE(refined->converged);
    EXPECT_EQ(refined->nodes.size(), 9U);
    EXPECT_GE(refined->valid_nodes(), 8) << "seed " << seed;
    for (const RefinedNode& node : refined->nodes) {
      if (!node.valid) continue;
      ++nodes;
      const Eigen::Vector2d e = scene.error(*refined, node);
      const Eigen::Vector2d white = node.covariance_m2.llt().matrixL().solve(e);
      for (int k = 0; k < 2; ++k) {
        error_mm.push_back(1e3 * e(k));
        normalized.push_back(white(k));
      }
    }
    // All nodes together fix the board far better than one of them.
    EXPECT_THAT(refined->lidar_from_board, test::IsNearPose(scene.truth, 2.0, 2.0));
  }
  RecordProperty("rms_error_um", static_cast<int>(1e3 * rms(error_mm)));
  RecordProperty("rms_normalized_percent", static_cast<int>(1e2 * rms(normalized)));
  EXPECT_GE(nodes, 80U);
  EXPECT_LE(rms(error_mm), 0.6);
  EXPECT_GT(rms(normalized), 0.85);
  EXPECT_LT(rms(normalized), 1.15);
}

TEST(BoardRefinement, WorksForEveryScanPattern) {
  for (const auto kind : {LidarKind::kRosette, LidarKind::kSpinning}) {
    const BoardScene scene(3, kind);
    const auto refined = scene.refine(scene.start());
    ASSERT_TRUE(refined.ok()) << refined.error().text();
    EXPECT_GE(refined->valid_nodes(), 6);
    EXPECT_THAT(refined->lidar_from_board, test::IsNearPose(scene.truth, 4.0, 5.0));
    for (const RefinedNode& node : refined->nodes) {
      if (!node.valid) continue;
      EXPECT_LT(scene.error(*refined, node).norm(), 5.0 * std::sqrt(2.0) * node.sigma_m() + 5e-4)
          << "node " << node.id;
    }
  }
}

TEST(BoardRefinement, ConvergesFromFarOff) {
  const BoardScene scene(4);
  const auto near = scene.refine(scene.truth);
  const auto far = scene.refine(scene.start(0.010, 2.0 * kDegree));
  ASSERT_TRUE(near.ok() && far.ok());
  EXPECT_TRUE(far->converged);
  // Other bins and other samples on the way leave a difference well below the noise.
  EXPECT_THAT(far->lidar_from_board, test::IsNearPose(near->lidar_from_board, 0.25, 0.5));
  // The start is kept for comparison: the far one was 10 mm and 2° off.
  double raw = 0.0;
  for (const RefinedNode& node : far->nodes) {
    const Eigen::Vector3d truth =
        scene.truth * Eigen::Vector3d(node.board_m.x(), node.board_m.y(), 0.0);
    raw = std::max(raw, (node.raw_lidar_m - truth).norm());
    EXPECT_LT((node.center_lidar_m - truth).norm(), 0.003);
  }
  EXPECT_GT(raw, 0.008);
}

TEST(BoardRefinement, HistoryHoldsEveryNodeAndBinOfEveryIteration) {
  const BoardScene scene(5);
  const RefinementOptions options;
  const auto refined = scene.refine(scene.start(), options);
  ASSERT_TRUE(refined.ok());
  ASSERT_GE(refined->history.size(), 3U);
  EXPECT_LE(refined->history.size(), static_cast<std::size_t>(options.max_iterations));
  for (const IterationRecord& iteration : refined->history) {
    ASSERT_EQ(iteration.nodes.size(), 9U);
    EXPECT_GT(iteration.transition_sigma_m, 0.0);
    for (std::size_t n = 0; n < 9; ++n) {
      const NodeRecord& node = iteration.nodes[n];
      EXPECT_EQ(node.id, static_cast<int>(n));
      EXPECT_GE(node.bins.size(), static_cast<std::size_t>(options.min_bins));
      EXPECT_LE(node.bins.size(), static_cast<std::size_t>(options.max_bins));
      EXPECT_GT(node.outer_level, node.inner_level);
      for (const BinRecord& bin : node.bins) {
        if (bin.state != BinState::kUsed) continue;
        EXPECT_GT(bin.sigma_m, 0.0);
        EXPECT_GE(bin.samples, options.min_bin_samples);
        EXPECT_TRUE(std::isfinite(bin.midpoint_m));
      }
    }
  }
  EXPECT_TRUE(refined->converged);
  EXPECT_LT(refined->history.back().max_update_m, options.tolerance_m);
  EXPECT_GT(refined->history.front().max_update_m, options.tolerance_m);
  // The result is the last iteration's.
  for (std::size_t n = 0; n < 9; ++n) {
    const NodeRecord& last = refined->history.back().nodes[n];
    EXPECT_LT((refined->nodes[n].center_uv_m - last.center_uv_m - last.wave_m.head<2>()).norm(),
              1e-12);
  }
}

TEST(BoardRefinement, IterationsThatRunOutAreSaid) {
  const BoardScene scene(5);
  RefinementOptions options;
  options.max_iterations = 2;
  const auto refined = scene.refine(scene.start(0.01, 2.0 * kDegree), options);
  ASSERT_TRUE(refined.ok());
  EXPECT_FALSE(refined->converged);
  EXPECT_EQ(refined->history.size(), 2U);
  ASSERT_FALSE(refined->warnings.empty());
  EXPECT_THAT(refined->warnings.front(), HasSubstr("did not settle"));
}

TEST(BoardRefinement, MeasuresFootprintNoiseAndSize) {
  const BoardScene scene(6);
  const auto refined = scene.refine(scene.start());
  ASSERT_TRUE(refined.ok());
  // The simulator's sharp edges come back blurred by some 1 mrad.
  const double range = refined->plane.center_m.norm();
  const double blur = std::sqrt(0.5 * refined->footprint_m2.trace());
  EXPECT_GT(blur, 0.6e-3 * range);
  EXPECT_LT(blur, 2.2e-3 * range);
  EXPECT_NEAR(refined->plane.sigma_range_m, 0.009, 0.003);
  EXPECT_GT(refined->intensity_noise, 0.01);
  EXPECT_LT(refined->intensity_noise, 0.1);
  ASSERT_GT(refined->scale_sigma, 0.0);
  EXPECT_NEAR(refined->scale, 1.0, 5.0 * refined->scale_sigma);
  EXPECT_LT(refined->scale_sigma, 0.002);
}

TEST(BoardRefinement, AWrongBoardSizeShowsInTheScale) {
  BoardScene scene(7);
  scene.target.tag_size_m /= 1.01;
  scene.target.circle_radius_m /= 1.01;
  scene.target.margin_m /= 1.01;
  const auto refined = scene.refine(scene.truth);
  ASSERT_TRUE(refined.ok());
  EXPECT_NEAR(refined->scale, 1.01, 5.0 * refined->scale_sigma);
}

TEST(BoardRefinement, ACutAwayPartCostsItsNodesOnly) {
  BoardScene scene(8);
  const Rigid3 board_from_lidar = scene.truth.inverse();
  // Beyond the circles of the first column.
  const double cut = scene.target.nodes()[0].center_m.x() + 0.06;
  Cloud kept;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    if ((board_from_lidar * scene.points.points_m[i].cast<double>().eval()).x() > cut)
      append_point(kept, scene.points, i);
  }
  scene.points = kept;
  const auto refined = scene.refine(scene.start(0.003, 0.3 * kDegree));
  ASSERT_TRUE(refined.ok());
  EXPECT_GE(refined->valid_nodes(), 5);
  EXPECT_LE(refined->valid_nodes(), 6);
  for (const RefinedNode& node : refined->nodes) {
    if (node.id % 3 == 0) {
      EXPECT_FALSE(node.valid) << "node " << node.id;
      EXPECT_FALSE(node.reason.empty());
    } else if (node.valid) {
      EXPECT_LT(scene.error(*refined, node).norm(), 0.003);
    }
  }
}

TEST(BoardRefinement, WithoutCirclesThereIsAPlaneOnly) {
  BoardScene scene(9);
  scene.target.type = TargetType::kAprilGrid;
  scene.points.intensity.clear();
  const auto refined = scene.refine(scene.start());
  ASSERT_TRUE(refined.ok()) << refined.error().text();
  EXPECT_TRUE(refined->converged);
  EXPECT_TRUE(refined->nodes.empty());
  EXPECT_TRUE(refined->history.empty());
  EXPECT_GT(refined->board_points, 1000U);
  const Eigen::Vector3d normal = scene.truth.rotation * Eigen::Vector3d::UnitZ();
  const double turn = std::acos(std::min(1.0, normal.dot(refined->plane.normal)));
  EXPECT_LT(turn, 0.003);
  EXPECT_NEAR(normal.dot(scene.truth.translation - refined->plane.center_m), 0.0, 0.002);
}

TEST(BoardRefinement, WithoutContrastThePlaneIsLeft) {
  BoardScene scene(9);
  std::fill(scene.points.intensity.begin(), scene.points.intensity.end(), 3.0F);
  const auto same = scene.refine(scene.start());
  scene.points.intensity.clear();
  const auto none = scene.refine(scene.start());
  for (const auto& refined : {same, none}) {
    ASSERT_TRUE(refined.ok()) << refined.error().text();
    EXPECT_TRUE(refined->converged);
    EXPECT_TRUE(refined->nodes.empty());
    EXPECT_GT(refined->board_points, 1000U);
  }
}

TEST(BoardRefinement, TooFewPointsAreRefusedWithTheirNumber) {
  BoardScene scene(9);
  Cloud few;
  const Eigen::Vector2d c = scene.target.outline().center_m();
  for (int i = 0; i < 7; ++i) {
    few.points_m.push_back(
        (scene.truth * Eigen::Vector3d(c.x() + 0.02 * i, c.y() + 0.01 * i * i, 0.0)).cast<float>());
    few.intensity.push_back(50.0F);
  }
  for (const Cloud& cloud : {few, Cloud{}}) {
    scene.points = cloud;
    const auto refined = scene.refine(scene.truth);
    ASSERT_FALSE(refined.ok());
    EXPECT_EQ(refined.error().kind, ErrorKind::kInput);
    EXPECT_THAT(refined.error().message, HasSubstr(std::to_string(cloud.size()) + " LiDAR points"));
    EXPECT_FALSE(refined.error().hint.empty());
  }
}

TEST(BoardRefinement, CanBeCancelled) {
  const BoardScene scene(9);
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const auto refined = refine_board(scene.points, scene.target, scene.truth, {}, context);
  ASSERT_FALSE(refined.ok());
  EXPECT_EQ(refined.error().kind, ErrorKind::kCancelled);
}

TEST(BinStates, AreDescribedDifferently) {
  std::set<std::string> texts;
  for (const BinState state : {BinState::kUsed, BinState::kTooFewSamples, BinState::kWeakContrast,
                               BinState::kOneSided, BinState::kNoCrossing, BinState::kOutlier}) {
    EXPECT_FALSE(describe(state).empty());
    texts.insert(describe(state).text());
  }
  EXPECT_EQ(texts.size(), 6U);
}

// The paper's centres: on the printed layout exactly, each with one σ and that not below the floor.
TEST(BoardRefinement, AsInThePaperCentresLieOnTheLayout) {
  const BoardScene scene(2, LidarKind::kAvia, 1);
  const RefinementOptions options = as_in_paper({});
  const auto paper = scene.refine(scene.start(), options);
  const auto ours = scene.refine(scene.start());
  ASSERT_TRUE(paper.ok() && ours.ok());
  ASSERT_GE(paper->valid_nodes(), 7);
  for (const RefinedNode& node : paper->nodes) {
    for (const RefinedNode& other : paper->nodes) {
      EXPECT_NEAR((node.center_lidar_m - other.center_lidar_m).norm(),
                  (node.board_m - other.board_m).norm(), 1e-9);
    }
    if (!node.valid) continue;
    EXPECT_LT(scene.error(*paper, node).norm(), 0.003) << "node " << node.id;
    EXPECT_EQ(node.covariance_m2(0, 1), 0.0);
    EXPECT_EQ(node.covariance_m2(0, 0), node.covariance_m2(1, 1));
    EXPECT_GE(node.sigma_m(), options.midpoint_sigma_floor_m);
  }
  EXPECT_THAT(paper->lidar_from_board, test::IsNearPose(scene.truth, 3.0, 3.0));
  // Another estimator on the same plane.
  EXPECT_EQ(paper->plane.center_m, ours->plane.center_m);
  EXPECT_GT((paper->nodes[4].center_lidar_m - ours->nodes[4].center_lidar_m).norm(), 1e-6);
}

// On a tilted board range noise moves the feet of samples sideways, and along the ray it does not.
TEST(BoardRefinement, SamplesAlongTheirRaysScatterLess) {
  BoardScene scene(2, LidarKind::kAvia, 1);
  const Eigen::Vector3d normal = scene.truth.rotation * Eigen::Vector3d::UnitZ();
  const double incidence = std::acos(-normal.dot(scene.truth.translation.normalized()));
  ASSERT_GT(std::abs(incidence), 10.0 * kDegree);
  // Twice two centimetres of range noise that is none on average.
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    Eigen::Vector3f& p = scene.points.points_m[i];
    p += (i % 2 == 0 ? 0.02F : -0.02F) * p.normalized();
  }
  RefinementOptions options = as_in_paper({});
  const auto feet = scene.refine(scene.truth, options);
  options.along_rays = true;
  const auto rays = scene.refine(scene.truth, options);
  ASSERT_TRUE(feet.ok() && rays.ok());
  std::vector<double> by_feet;
  std::vector<double> by_rays;
  for (std::size_t n = 0; n < feet->nodes.size(); ++n) {
    if (!feet->nodes[n].valid || !rays->nodes[n].valid) continue;
    by_feet.push_back(feet->nodes[n].sigma_m());
    by_rays.push_back(rays->nodes[n].sigma_m());
  }
  ASSERT_GE(by_feet.size(), 5U);
  EXPECT_GT(rms(by_feet), rms(by_rays));
}

}  // namespace
}  // namespace lvcalib
