// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/cloud_geometry.h"

#include <gtest/gtest.h>

namespace lvcalib::widgets::cloud_geometry_test {
namespace {

TEST(CloudGeometry, BoxToMatrixAndBack) {
  CropBox box;
  box.center_m = {3, -1, 0.5};
  box.half_size_m = {0.2, 0.6, 1.1};
  box.rotation = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized());
  const Eigen::Matrix4d matrix = cube_to_box(box);
  const Eigen::Vector4d corner = matrix * Eigen::Vector4d(1, 1, -1, 1);
  EXPECT_LT(
      (corner.head<3>() - (box.center_m + box.rotation * Eigen::Vector3d(0.2, 0.6, -1.1))).norm(),
      1e-12);
  const CropBox back = box_of_cube(matrix);
  EXPECT_LT((back.center_m - box.center_m).norm(), 1e-12);
  EXPECT_LT((back.half_size_m - box.half_size_m).norm(), 1e-12);
  EXPECT_LT(back.rotation.angularDistance(box.rotation), 1e-7);
}

TEST(CloudGeometry, AMirroredOrFlatMapIsStillABox) {
  Eigen::Matrix4d mirrored = Eigen::Matrix4d::Identity();
  mirrored(2, 2) = -1.0;
  EXPECT_TRUE(check(box_of_cube(mirrored)).ok());
  CropBox thin;
  thin.half_size_m.y() = 1e-7;
  EXPECT_GE(box_of_cube(cube_to_box(thin)).half_size_m.y(), 1e-3);
}

TEST(CloudGeometry, AFlightTurnsAboutTheFocusWithoutJumps) {
  const Viewer from{{4, 0, 0}, {0, 0, 0}, Eigen::Vector3d::UnitZ(), 30.0};
  const Viewer to{{0, 1, 3}, {0, 1, 0}, Eigen::Vector3d::UnitX(), 60.0};
  EXPECT_LT((between(from, to, 0.0).eye_m - from.eye_m).norm(), 1e-12);
  EXPECT_EQ(between(from, to, 1.0).eye_m, to.eye_m);
  EXPECT_LT((between(from, to, 1.0 - 1e-9).eye_m - to.eye_m).norm(), 1e-6);
  EXPECT_LT((between(from, to, 1.0 - 1e-9).up - to.up).norm(), 1e-6);
  Viewer last = from;
  for (int k = 1; k <= 100; ++k) {
    const Viewer now = between(from, to, 0.01 * k);
    const double away_m = (now.eye_m - now.focus_m).norm();
    EXPECT_GE(away_m, 3.0 - 1e-9);
    EXPECT_LE(away_m, 4.0 + 1e-9);
    EXPECT_LT((now.eye_m - last.eye_m).norm(), 0.15);
    EXPECT_NEAR(now.up.dot(now.eye_m - now.focus_m), 0.0, 1e-9);
    last = now;
  }
}

TEST(CloudGeometry, ViewpointsLookAtTheFocusWithAnUpThatIsAcross) {
  for (const auto viewpoint :
       {CloudViewpoint::kWhole, CloudViewpoint::kTop, CloudViewpoint::kSensor}) {
    for (const Eigen::Vector3d& focus :
         {Eigen::Vector3d(4, 1, 0.2), Eigen::Vector3d(0, 0, 5), Eigen::Vector3d(-3, 0, -1)}) {
      const ViewerPose pose = viewer_pose(viewpoint, focus);
      const Eigen::Vector3d sight = focus - pose.eye_m;
      EXPECT_GT(sight.cross(pose.up).norm(), 0.05 * sight.norm());
    }
  }
  EXPECT_EQ(viewer_pose(CloudViewpoint::kSensor, {4, 1, 0}).eye_m, Eigen::Vector3d::Zero());
  EXPECT_EQ(viewer_pose(CloudViewpoint::kTop, {4, 1, 0}).eye_m, Eigen::Vector3d(4, 1, 1));
}

}  // namespace
}  // namespace lvcalib::widgets::cloud_geometry_test
