// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/plan_text.h"

#include <gtest/gtest.h>

namespace lvcalib::widgets::plan_text_test {
namespace {

GridPose pose(double distance_m, double right_deg, double down_deg) {
  GridPose out;
  out.distance_m = distance_m;
  out.right_deg = right_deg;
  out.down_deg = down_deg;
  return out;
}

TEST(PlanText, SaysWhereTheBoardGoes) {
  EXPECT_EQ(board_place(pose(2.0, 0.4, -1.0)), "2.0 m ahead, in the middle, facing the camera");
  GridPose turned = pose(3.0, -20.0, -15.0);
  turned.tilt_y_deg = 30.0;
  turned.roll_deg = 45.0;
  EXPECT_EQ(board_place(turned),
            "3.0 m ahead, upper left, right side 30\u00b0 back, rolled 45\u00b0 left");
  turned.roll_deg = -90.0;
  EXPECT_TRUE(board_place(turned).endsWith("rolled 90\u00b0 right"));
  GridPose tipped = pose(1.5, 20.0, 15.0);
  tipped.tilt_x_deg = -55.0;
  EXPECT_EQ(board_place(tipped), "1.5 m ahead, lower right, upper side 55\u00b0 back");
  tipped.tilt_x_deg = 55.0;
  EXPECT_EQ(board_place(tipped), "1.5 m ahead, lower right, upper side 55\u00b0 nearer");
}

TEST(PlanText, LidarsKeepTheirNames) {
  EXPECT_EQ(lidar_name("Six-line rosette"), "Six-line rosette");
  EXPECT_EQ(lidar_name("Mine"), "Mine");
}

TEST(PlanText, TiltIsTheAngleToTheLineOfSight) {
  GridPose tilted = pose(2.0, 0.0, 0.0);
  EXPECT_NEAR(board_tilt_deg(tilted), 0.0, 1e-6);
  tilted.tilt_x_deg = -55.0;
  EXPECT_NEAR(board_tilt_deg(tilted), 55.0, 1e-9);
}

TEST(PlanText, SigmasAreRootsOfSums) {
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal() << 4e-6, 4e-6, 1e-6, 1e-8, 0.0, 0.0;
  EXPECT_NEAR(sigma_mm(covariance), 3.0, 1e-9);
  EXPECT_NEAR(sigma_mrad(covariance), 0.1, 1e-9);
  EXPECT_EQ(sigma_text(3.0), "3.0");
  EXPECT_EQ(sigma_text(0.1234), "0.12");
  EXPECT_EQ(sigma_text(12.4), "12");
  EXPECT_EQ(sigma_text(0.0123), "0.012");
  EXPECT_EQ(sigma_text(0.0), "0.000");
}

}  // namespace
}  // namespace lvcalib::widgets::plan_text_test
