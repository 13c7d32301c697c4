// SPDX-License-Identifier: GPL-3.0-or-later
// Scanners of 16 and 32 lines before a checkerboard: five lines cross it at 4 m, and only its
// outline tells where to begin.
#include <algorithm>
#include <string>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "cloud/cloud.h"
#include "pipeline/calibration.h"
#include "support/ordinary_boards.h"
#include "support/simulated_dataset.h"

namespace lvcalib {
namespace {

// Of 0.61 m by 0.85 m.
Target small_checkerboard() {
  Target t = test::checkerboard_target();
  t.corner_columns = 5;
  t.corner_rows = 7;
  t.column_spacing_m = t.row_spacing_m = 0.095;
  t.board_width_m = 0.61;
  t.board_height_m = 0.85;
  return t;
}

class FewLines : public ::testing::TestWithParam<int> {};

TEST_P(FewLines, FindACheckerboardInEveryScene) {
  simulation::SimulationOptions options = test::dataset_options(7, 6);
  options.target = small_checkerboard();
  options.lidar.kind = simulation::LidarKind::kSpinning;
  options.lidar.lines = GetParam();
  options.lidar.points = 0;
  options.placement.min_distance_m = 1.5;
  options.placement.max_tilt_deg = 45.0;
  options.placement.max_roll_deg = 60.0;
  options.effects = {{"beam_divergence", 2.0}};
  const test::SimulatedDataset data(options);
  const auto result = calibrate(data.open(), {}, {});
  ASSERT_TRUE(result.ok()) << result.error().text();
  for (const SceneResult& scene : result->scenes)
    EXPECT_TRUE(scene.used) << scene.name << ": " << scene.reason.text();
  EXPECT_EQ(result->quality, Quality::kGood)
      << (result->quality_reasons.empty() ? "" : result->quality_reasons.front().text());
  const UncertainRigid3& found = result->extrinsic.camera_from_lidar;
  const Vector6d off = se3_log(found.transform * data.rig().camera_from_lidar.inverse());
  // χ² with six degrees of freedom, once in a thousand.
  EXPECT_LT(off.dot(found.covariance.ldlt().solve(off)), 22.5);
  EXPECT_LT(1e3 * off.head<3>().norm(), 5.0);
}

// Of a board with circles none can be measured; that is said once.
TEST(FewLinesBeforeCircles, SayOnceThatTheyCannotBeMeasured) {
  simulation::SimulationOptions options = test::dataset_options(8, 4);
  options.lidar.kind = simulation::LidarKind::kSpinning;
  options.lidar.lines = 16;
  options.lidar.points = 0;
  const test::SimulatedDataset data(options);
  const auto result = calibrate(data.open(), {}, {});
  ASSERT_TRUE(result.ok()) << result.error().text();
  EXPECT_EQ(result->quality, Quality::kGood);
  EXPECT_EQ(std::count_if(result->warnings.begin(), result->warnings.end(),
                          [](const Message& warning) {
                            return warning.text().find("circles cannot be measured") !=
                                   std::string::npos;
                          }),
            1);
}

// A board that returns too little to be found contradicts nobody, whatever else in the room looks
// like one; its print elsewhere does.
TEST(FewPoints, OnABoardAreNoContradictionButItsPrintElsewhereIs) {
  constexpr std::size_t kScene = 3;
  constexpr int kKept = 20;  // One point of so many, and these say nothing of the print.
  const test::SimulatedDataset data(test::dataset_options(9, 4));
  const Dataset dataset = data.open();
  const simulation::SimulatedScene& scene = data.rig().scenes[kScene];
  const BoardOutline outline = data.rig().target.outline();
  const Rigid3 board_from_lidar = scene.lidar_from_board.inverse();
  const Eigen::AngleAxisf aside(0.7F, Eigen::Vector3f::UnitZ());
  for (const bool elsewhere : {false, true}) {
    Cloud cloud;
    int on_board = 0;
    const auto add = [&](const Eigen::Vector3f& p, float intensity) {
      cloud.points_m.push_back(p);
      cloud.intensity.push_back(intensity);
    };
    for (std::size_t i = 0; i < scene.cloud.size(); ++i) {
      const Eigen::Vector3f p = scene.cloud.points_m[i];
      const Eigen::Vector3d at = board_from_lidar * p.cast<double>().eval();
      const bool board = std::abs(at.z()) < 0.05 && outline.contains(at.head<2>());
      if (!board) add(p, scene.cloud.intensity[i]);
      if (board && on_board++ % kKept == 0) add(p, 40.0F);
      if (board && elsewhere) add(aside * p, scene.cloud.intensity[i]);
    }
    ASSERT_TRUE(write_pcd(dataset.scenes[kScene].cloud, cloud).ok());
    const auto result = calibrate(dataset, {}, {});
    ASSERT_TRUE(result.ok()) << result.error().text();
    const SceneResult& without = result->scenes[kScene];
    EXPECT_FALSE(without.used);
    EXPECT_EQ(without.place, BoardPlace::kTaken);
    EXPECT_EQ(without.contradicts, elsewhere) << without.reason.text();
    EXPECT_EQ(result->quality, elsewhere ? Quality::kDoubtful : Quality::kGood);
  }
}

// Half of the board of one scene is above the LiDAR's field of view, too little for the search.
TEST(CutOffBoard, IsUsedWhereTheOthersPutIt) {
  simulation::SimulationOptions options = test::dataset_options(9'940'004, 3);
  options.target = test::checkerboard_target();
  options.lidar.kind = simulation::LidarKind::kSpinning;
  options.lidar.lines = 64;
  options.lidar.points = 60'000;
  const test::SimulatedDataset data(options);
  const auto result = calibrate(data.open(), {}, {});
  ASSERT_TRUE(result.ok()) << result.error().text();
  EXPECT_EQ(result->extrinsic.used_scenes, 3);
  EXPECT_EQ(result->quality, Quality::kGood);
  ASSERT_TRUE(result->forward);
  double seen = 1.0;
  for (const auto& scene : result->forward->scenes) seen = std::min(seen, scene.seen);
  EXPECT_LT(seen, 0.6);
  const Vector6d off = se3_log(data.rig().camera_from_lidar *
                               result->extrinsic.camera_from_lidar.transform.inverse());
  const Matrix6d& covariance = result->extrinsic.camera_from_lidar.covariance;
  for (int k = 0; k < 6; ++k) EXPECT_LT(std::abs(off(k)), 4.0 * std::sqrt(covariance(k, k))) << k;
}

INSTANTIATE_TEST_SUITE_P(Lines, FewLines, ::testing::Values(16, 32));

}  // namespace
}  // namespace lvcalib
