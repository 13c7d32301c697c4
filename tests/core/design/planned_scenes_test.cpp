// SPDX-License-Identifier: GPL-3.0-or-later
// Planned poses taken by the simulator: what the plan promised against what calibrate states.
#include <cmath>

#include <gtest/gtest.h>

#include "design/planning.h"
#include "pipeline/calibration.h"
#include "support/simulated_dataset.h"

namespace lvcalib {
namespace {

TEST(PlannedScenes, CalibrateStatesThePredictedDeviations) {
  simulation::SimulationOptions options;
  options.seed = 21;
  options.scenes = 4;
  options.image.width_px = 1440;
  options.image.height_px = 900;
  const auto rig = simulation::Simulator::create(options);
  ASSERT_TRUE(rig.ok());
  const std::filesystem::path file =
      std::filesystem::path(LVCALIB_SOURCE_DIR) / "resources" / "lidars" / "avia.yaml";
  auto lidar = read_lidar(file);
  ASSERT_TRUE(lidar.ok()) << lidar.error().text();
  lidar->lidar.camera_from_lidar = rig->rig().camera_from_lidar;
  PlanOptions wanted;
  wanted.scenes = options.scenes;
  // The room is 5 m deep, and what blurs at its far end is not what is asked here.
  wanted.grid.distances_m = {1.5, 2.0, 2.5, 3.0};
  wanted.grid.tilts_deg = {-35.0, 0.0, 35.0};
  wanted.grid.rolls_deg = {0.0};
  const auto plan = plan_scenes(options.target, rig->rig().camera, lidar->lidar, wanted, {});
  ASSERT_TRUE(plan.ok()) << plan.error().text();
  for (const PlannedScene& scene : plan->scenes)
    options.placement.lidar_from_board.push_back(scene.lidar_from_board);

  const test::SimulatedDataset data(options);
  for (std::size_t k = 0; k < data.rig().scenes.size(); ++k) {
    EXPECT_LT(translation_distance_m(data.rig().scenes[k].lidar_from_board,
                                     plan->scenes[k].lidar_from_board),
              1e-9);
  }
  const auto result = calibrate(data.open(), {}, {});
  ASSERT_TRUE(result.ok()) << result.error().text();
  const Matrix6d& stated = result->extrinsic.camera_from_lidar.covariance;
  const Matrix6d& predicted = plan->scenes.back().covariance;
  for (int first : {0, 3}) {
    const double ratio = std::sqrt(predicted.diagonal().segment<3>(first).sum() /
                                   stated.diagonal().segment<3>(first).sum());
    RecordProperty(first == 0 ? "translation_ratio" : "rotation_ratio", std::to_string(ratio));
    EXPECT_GT(ratio, 0.67) << (first == 0 ? "translation" : "rotation");
    EXPECT_LT(ratio, 1.5) << (first == 0 ? "translation" : "rotation");
  }
}

}  // namespace
}  // namespace lvcalib
