// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/corner_fit.h"

#include <gtest/gtest.h>

#include "solve/robust_fit.h"
#include "support/pose_matchers.h"
#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

class CornerFitting : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<SceneObservations> scenes(int count, std::uint64_t seed) const {
    return test::observed_scenes(count, target_, camera_, truth_, noise_, seed);
  }
  static ObservationMask all_of(const std::vector<SceneObservations>& scenes) {
    ObservationMask mask;
    for (const SceneObservations& scene : scenes) {
      mask.scene.push_back(true);
      mask.corner.emplace_back(scene.corners.size(), true);
      mask.node.emplace_back(scene.nodes.size(), true);
    }
    return mask;
  }
  Target target_;
  Camera camera_ = test::test_camera();
  Rigid3 truth_ = test::test_extrinsic();
  test::ObservationNoise noise_;
  ExtrinsicOptions options_;
};

TEST_F(CornerFitting, SigmaIsTheCornerNoise) {
  // 3 × 64 corners: σ̂ has a standard deviation of σ/√(2·366) = 3.7 %.
  double sum = 0.0;
  constexpr int kDraws = 20;
  for (std::uint64_t seed = 1; seed <= kDraws; ++seed) {
    const auto observations = scenes(3, seed);
    const double sigma =
        fit_corners({observations, camera_, target_, options_}, all_of(observations)).sigma_px;
    EXPECT_NEAR(sigma, noise_.corner_px, 4 * 0.037 * noise_.corner_px);
    sum += sigma / kDraws;
  }
  EXPECT_NEAR(sum, noise_.corner_px, 3 * 0.037 / std::sqrt(kDraws) * noise_.corner_px);
}

TEST_F(CornerFitting, FarOffStartsLeadToTheSamePosesAndSigma) {
  auto observations = scenes(3, 5);
  const CornerFit near =
      fit_corners({observations, camera_, target_, options_}, all_of(observations));
  Random random(5);
  for (SceneObservations& scene : observations)
    scene.camera_from_board = test::disturbed(scene.camera_from_board, random, 0.05, 0.05);
  const CornerFit far =
      fit_corners({observations, camera_, target_, options_}, all_of(observations));
  EXPECT_NEAR(far.sigma_px, near.sigma_px, 0.02 * near.sigma_px);
  for (std::size_t s = 0; s < 3; ++s) {
    EXPECT_THAT(far.camera_from_board[s], test::IsNearPose(near.camera_from_board[s], 0.02, 0.02));
  }
}

TEST_F(CornerFitting, WhatTheLidarSaysPlaysNoPart) {
  auto observations = scenes(3, 6);
  const CornerFit before =
      fit_corners({observations, camera_, target_, options_}, all_of(observations));
  for (SceneObservations& scene : observations) {
    scene.plane.center_m.x() += 0.3;
    for (RefinedNode& node : scene.nodes) node.center_lidar_m.y() -= 0.2;
  }
  const CornerFit after =
      fit_corners({observations, camera_, target_, options_}, all_of(observations));
  EXPECT_EQ(before.sigma_px, after.sigma_px);
}

TEST_F(CornerFitting, HiddenCornersAndScenesTakeNoPart) {
  auto observations = scenes(3, 7);
  ObservationMask mask = all_of(observations);
  mask.scene[1] = false;
  mask.corner[0][0] = false;
  const double before = fit_corners({observations, camera_, target_, options_}, mask).sigma_px;
  observations[0].corners[0].pixel.x() += 50.0;
  for (CornerObservation& c : observations[1].corners) c.pixel.setZero();
  const CornerFit after = fit_corners({observations, camera_, target_, options_}, mask);
  EXPECT_EQ(after.sigma_px, before);
  EXPECT_EQ(after.camera_from_board[1].matrix(), observations[1].camera_from_board.matrix());
}

TEST_F(CornerFitting, NothingToFitGivesTheFloor) {
  EXPECT_EQ(fit_corners({{}, camera_, target_, options_}, {}).sigma_px, options_.sigma_px_floor);
  noise_.corner_px = 0.0;
  const auto exact = scenes(3, 8);
  EXPECT_EQ(fit_corners({exact, camera_, target_, options_}, all_of(exact)).sigma_px,
            options_.sigma_px_floor);
}

}  // namespace
}  // namespace lvcalib
