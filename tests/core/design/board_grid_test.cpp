// SPDX-License-Identifier: GPL-3.0-or-later
#include "design/board_grid.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;

Eigen::Vector3d center_of(const Target& target, const GridPose& pose) {
  const Eigen::Vector2d c = target.outline().center_m();
  return pose.camera_from_board * Eigen::Vector3d(c.x(), c.y(), 0.0);
}

TEST(BoardGrid, PosesAreWhatTheirNumbersSay) {
  const Target target;
  const Camera camera = test::test_camera();
  const auto poses = board_grid(target, camera, {});
  ASSERT_GT(poses.size(), 50U);
  bool tilted = false;
  for (const GridPose& pose : poses) {
    const Eigen::Vector3d center = center_of(target, pose);
    EXPECT_NEAR(center.norm(), pose.distance_m, 1e-9);
    EXPECT_NEAR(std::atan2(center.x(), center.z()) * 180.0 / M_PI, pose.right_deg, 1e-6);
    // The normal's angle to the line of sight is the tilt.
    const Eigen::Vector3d normal = pose.camera_from_board.rotation * Eigen::Vector3d::UnitZ();
    const double tilt = std::acos(std::min(1.0, -normal.dot(center.normalized())));
    EXPECT_NEAR(tilt * 180.0 / M_PI, std::abs(pose.tilt_x_deg) + std::abs(pose.tilt_y_deg), 1e-5);
    tilted = tilted || pose.tilt_x_deg != 0.0;
  }
  EXPECT_TRUE(tilted);
}

TEST(BoardGrid, DirectionsOfTiltAreAsDescribed) {
  const Target target;
  for (const GridPose& pose : board_grid(target, test::test_camera(), {})) {
    if (pose.roll_deg != 0.0) continue;
    const BoardOutline o = target.outline();
    const auto depth = [&](double x, double y) {
      return (pose.camera_from_board * Eigen::Vector3d(x, y, 0.0)).norm();
    };
    const double mid_x = o.center_m().x();
    const double mid_y = o.center_m().y();
    if (pose.tilt_x_deg > 0.0) {
      EXPECT_LT(depth(mid_x, o.upper_right_m.y()), depth(mid_x, o.lower_left_m.y()));
    }
    if (pose.tilt_y_deg > 0.0) {
      EXPECT_GT(depth(o.upper_right_m.x(), mid_y), depth(o.lower_left_m.x(), mid_y));
    }
  }
}

TEST(BoardGrid, KeepsToWhatTheCameraSees) {
  const Target target;
  const Camera camera = test::test_camera();
  for (const GridPose& pose : board_grid(target, camera, {})) {
    for (const TargetTag& tag : target.tags()) {
      for (const Eigen::Vector2d& corner : target.tag_corners_m(tag)) {
        const auto pixel =
            camera.project(pose.camera_from_board * Eigen::Vector3d(corner.x(), corner.y(), 0.0));
        ASSERT_TRUE(pixel.has_value());
        EXPECT_TRUE(camera.in_image(*pixel));
      }
    }
  }
  BoardGridOptions sharp;
  sharp.min_tag_px = 1e4;
  EXPECT_TRUE(board_grid(target, camera, sharp).empty());
}

TEST(BoardGrid, TheWholeBoardIsInTheImageWithRoomForAHand) {
  const Target target;
  const Camera camera = test::test_camera();
  const BoardOutline outline = target.outline();
  const double room_px = 0.029 * std::min(camera.width_px, camera.height_px);
  for (const GridPose& pose : board_grid(target, camera, {})) {
    for (const double x : {outline.lower_left_m.x(), outline.upper_right_m.x()}) {
      for (const double y : {outline.lower_left_m.y(), outline.upper_right_m.y()}) {
        const auto pixel = camera.project(pose.camera_from_board * Eigen::Vector3d(x, y, 0.0));
        ASSERT_TRUE(pixel);
        EXPECT_GT(pixel->x(), room_px);
        EXPECT_GT(pixel->y(), room_px);
        EXPECT_LT(pixel->x(), camera.width_px - room_px);
        EXPECT_LT(pixel->y(), camera.height_px - room_px);
      }
    }
  }
}

TEST(BoardGrid, SaysWhereTheBoardGoes) {
  GridPose pose;
  pose.distance_m = 2.0;
  EXPECT_EQ(pose.text(), "at 2.0 m, in the middle of the image, facing the camera");
  pose.right_deg = -12.0;
  pose.down_deg = 5.0;
  pose.tilt_y_deg = 30.0;
  pose.roll_deg = 45.0;
  EXPECT_EQ(pose.text(),
            "at 2.0 m, 12° left and 5° below of the optical axis, the right side turned away by "
            "30°, rolled by 45°");
}

TEST(BoardGrid, RefusesGridsThatAreNone) {
  BoardGridOptions options;
  EXPECT_TRUE(options.check().ok());
  options.distances_m = {0.0};
  EXPECT_THAT(options.check().error().text(), HasSubstr("above zero"));
  options = {};
  options.tilts_deg.clear();
  EXPECT_FALSE(options.check().ok());
}

}  // namespace
}  // namespace lvcalib
