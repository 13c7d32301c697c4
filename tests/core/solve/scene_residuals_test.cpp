// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/scene_residuals.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

class SceneResiduals : public ::testing::Test {
 protected:
  SceneResiduals() {
    Random random(1);
    scene_ = test::observed_scene("A", target_, camera_, truth_, board_, {0, 0, 0, 0}, random);
    corners_.assign(scene_.corners.size(), true);
    nodes_.assign(scene_.nodes.size(), true);
  }
  Target target_;
  Camera camera_ = test::test_camera();
  Rigid3 truth_ = test::test_extrinsic();
  Rigid3 board_ = test::spread_board(target_, 1);
  SceneObservations scene_;
  std::vector<bool> corners_;
  std::vector<bool> nodes_;
};

TEST_F(SceneResiduals, VanishAtTheTruth) {
  for (const auto& r : corner_residuals(scene_, camera_, board_, corners_))
    EXPECT_LT(r.residual_px.norm(), 1e-9);
  for (const auto& r : node_residuals(scene_, truth_, board_, nodes_))
    EXPECT_LT(r.residual_m.norm(), 1e-9);
  for (const double h : plane_heights_mm(scene_, target_, truth_, board_)) EXPECT_NEAR(h, 0, 1e-6);
}

TEST_F(SceneResiduals, CornersAreMeasuredMinusPredictedInPixels) {
  scene_.corners[7].pixel += Eigen::Vector2d(0.5, -2.0);
  corners_[9] = false;
  const auto residuals = corner_residuals(scene_, camera_, board_, corners_);
  EXPECT_NEAR(residuals[7].residual_px.x(), 0.5, 1e-9);
  EXPECT_NEAR(residuals[7].residual_px.y(), -2.0, 1e-9);
  EXPECT_FALSE(residuals[9].used);
  EXPECT_TRUE(residuals[7].used);
}

TEST_F(SceneResiduals, ACornerOutOfTheCamerasSightIsMarkedNotZeroed) {
  Rigid3 behind = board_;
  behind.translation.z() = -5.0;
  for (const auto& r : corner_residuals(scene_, camera_, behind, corners_)) EXPECT_FALSE(r.used);
}

TEST_F(SceneResiduals, NodesAreMeasuredMinusCadInTheBoardFrame) {
  // 3 mm along the board's x axis and 2 mm towards the viewer.
  const Rigid3 lidar_from_board = truth_.inverse() * board_;
  scene_.nodes[2].center_lidar_m += lidar_from_board.rotation * Eigen::Vector3d(3e-3, 0, 2e-3);
  const auto residuals = node_residuals(scene_, truth_, board_, nodes_);
  EXPECT_NEAR((residuals[2].residual_m - Eigen::Vector3d(3e-3, 0, 2e-3)).norm(), 0, 1e-9);
  EXPECT_EQ(residuals[2].id, scene_.nodes[2].id);
}

TEST_F(SceneResiduals, PlaneHeightsAreMillimetresAlongTheNormal) {
  scene_.plane.center_m -= 1.5e-3 * scene_.plane.normal;
  for (const double h : plane_heights_mm(scene_, target_, truth_, board_))
    EXPECT_NEAR(h, 1.5, 1e-6);
}

}  // namespace
}  // namespace lvcalib
