// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/cloud_geometry.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace lvcalib::widgets {

Viewer between(const Viewer& from, const Viewer& to, double share) {
  if (share >= 1.0) return to;
  const double t = share * share * (3.0 - 2.0 * share);
  // Columns: right, up, backwards.
  const auto axes = [](const Viewer& v) {
    Eigen::Matrix3d r;
    r.col(2) = (v.eye_m - v.focus_m).normalized();
    r.col(0) = v.up.cross(r.col(2)).normalized();
    r.col(1) = r.col(2).cross(r.col(0));
    return Eigen::Quaterniond(r);
  };
  const Eigen::Matrix3d turned = axes(from).slerp(t, axes(to)).toRotationMatrix();
  const double near_m = (from.eye_m - from.focus_m).norm();
  const double far_m = (to.eye_m - to.focus_m).norm();
  Viewer out;
  out.focus_m = from.focus_m + t * (to.focus_m - from.focus_m);
  // Each step the same share nearer or farther.
  out.eye_m = out.focus_m + near_m * std::pow(far_m / near_m, t) * turned.col(2);
  out.up = turned.col(1);
  out.angle_deg = from.angle_deg + t * (to.angle_deg - from.angle_deg);
  return out;
}

ViewerPose viewer_pose(CloudViewpoint viewpoint, const Eigen::Vector3d& focus_m) {
  ViewerPose pose;
  switch (viewpoint) {
    case CloudViewpoint::kSensor:
      pose.angle_deg = 60.0;
      pose.fits_bounds = false;
      // Straight up or down there is no "up" along z.
      if (focus_m.head<2>().norm() < 0.01 * std::abs(focus_m.z()))
        pose.up = Eigen::Vector3d::UnitX();
      break;
    case CloudViewpoint::kTop:
      pose.eye_m = focus_m + Eigen::Vector3d::UnitZ();
      pose.up = Eigen::Vector3d::UnitX();
      break;
    case CloudViewpoint::kBoard:
      // Along the rays, where the print is seen as it was scanned.
      pose.up = focus_m.head<2>().norm() < 0.01 * std::abs(focus_m.z()) ? Eigen::Vector3d::UnitX()
                                                                        : Eigen::Vector3d::UnitZ();
      break;
    case CloudViewpoint::kMost:
    case CloudViewpoint::kWhole: {
      // Straight above or below the sensor any direction along the floor is as good.
      Eigen::Vector3d ahead = focus_m.normalized();
      if (!(ahead.head<2>().norm() > 0.3)) ahead = Eigen::Vector3d::UnitX();
      pose.eye_m = focus_m - ahead + Eigen::Vector3d(0.35 * ahead.y(), -0.35 * ahead.x(), 0.45);
      break;
    }
  }
  return pose;
}

Eigen::Matrix4d cube_to_box(const CropBox& box) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = box.rotation.toRotationMatrix() * box.half_size_m.asDiagonal();
  matrix.topRightCorner<3, 1>() = box.center_m;
  return matrix;
}

CropBox box_of_cube(const Eigen::Matrix4d& matrix) {
  constexpr double kSmallestHalf_m = 1e-3;
  CropBox box;
  Eigen::Matrix3d axes = matrix.topLeftCorner<3, 3>();
  for (int k = 0; k < 3; ++k) {
    const double length = axes.col(k).norm();
    box.half_size_m(k) = std::max(length, kSmallestHalf_m);
    axes.col(k) /= std::max(length, 1e-12);
  }
  // A handle pulled through the opposite side mirrors the box; a box has no sides to tell apart.
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  box.rotation = Eigen::Quaterniond(axes).normalized();
  box.center_m = matrix.topRightCorner<3, 1>();
  return box;
}

}  // namespace lvcalib::widgets
