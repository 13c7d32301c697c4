// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/robust_fit.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

class RobustFitting : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<SceneObservations> scenes(int count, std::uint64_t seed) const {
    return test::observed_scenes(count, target_, camera_, truth_, noise_, seed);
  }
  [[nodiscard]] RobustFit fit(const std::vector<SceneObservations>& observations) const {
    auto result = fit_robustly({observations, camera_, target_, options_});
    EXPECT_TRUE(result.ok());
    return std::move(result).value();
  }
  // The LiDAR's view of one scene is off as a whole.
  static void shift_lidar(SceneObservations& scene, const Eigen::Vector3d& by) {
    scene.lidar_from_board.translation += by;
    scene.plane.center_m += by;
    for (RefinedNode& node : scene.nodes) node.center_lidar_m += by;
  }
  Target target_;
  Camera camera_ = test::test_camera();
  Rigid3 truth_ = test::test_extrinsic();
  test::ObservationNoise noise_;
  ExtrinsicOptions options_;
};

TEST_F(RobustFitting, CleanScenesKeepEverythingAndTheirStatedNoise) {
  const RobustFit result = fit(scenes(4, 1));
  EXPECT_EQ(count_used(result.mask), 4);
  EXPECT_EQ(result.scales.node, 1.0);
  EXPECT_EQ(result.scales.plane, 1.0);
  for (const Message& reason : result.reasons) EXPECT_TRUE(reason.empty());
}

// A bad scene cannot hide behind corner noise, wherever the boards' poses start.
TEST_F(RobustFitting, ABadSceneIsFoundFromFarOffStarts) {
  for (std::uint64_t seed = 2; seed < 12; ++seed) {
    auto observations = scenes(5, seed);
    shift_lidar(observations[seed % 5], {0.01, 0.03, 0.0});
    Random random(seed);
    for (SceneObservations& scene : observations)
      scene.camera_from_board = test::disturbed(scene.camera_from_board, random, 0.03, 0.03);
    const RobustFit result = fit(observations);
    EXPECT_FALSE(result.mask.scene[seed % 5]) << "seed " << seed;
    EXPECT_EQ(count_used(result.mask), 4) << "seed " << seed;
    EXPECT_NEAR(result.scales.sigma_px, noise_.corner_px, 0.2 * noise_.corner_px);
  }
}

TEST_F(RobustFitting, TheGainAskedForDecidesWhetherASceneGoes) {
  auto observations = scenes(5, 3);
  shift_lidar(observations[1], {0.0, 0.004, 0.0});
  options_.scene_rejection_gain = 1e6;
  EXPECT_EQ(count_used(fit(observations).mask), 5);
  options_.scene_rejection_gain = 1.5;
  EXPECT_EQ(count_used(fit(observations).mask), 4);
}

TEST_F(RobustFitting, ABadTagDoesNotStayInTheCornerNoise) {
  auto observations = scenes(3, 4);
  const double clean = fit(observations).scales.sigma_px;
  const int bad = observations[0].corners[20].feature_id;
  for (CornerObservation& c : observations[0].corners) {
    if (c.feature_id == bad) c.pixel += Eigen::Vector2d(6.0, -3.0);
  }
  const RobustFit result = fit(observations);
  EXPECT_NEAR(result.scales.sigma_px, clean, 0.1 * clean);
  EXPECT_EQ(std::count(result.mask.corner[0].begin(), result.mask.corner[0].end(), false), 4);
}

TEST_F(RobustFitting, ObservationsThatAreNotNumbersAreRefused) {
  auto observations = scenes(3, 5);
  observations[0].plane.center_m.setConstant(std::numeric_limits<double>::quiet_NaN());
  observations[0].lidar_from_board.translation.setConstant(
      std::numeric_limits<double>::quiet_NaN());
  const auto result = fit_robustly({observations, camera_, target_, options_});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::kUntrusted);
}

}  // namespace
}  // namespace lvcalib
