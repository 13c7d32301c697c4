// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Small hand-made clouds of flat panels, for tests of the geometric search.

#include <Eigen/Core>

#include "base/random.h"
#include "base/rigid3.h"
#include "cloud/cloud.h"

namespace lvcalib::test {

/// A rectangle of random points with `noise_m` along its normal; the pose takes its middle to the
/// LiDAR frame.
inline void add_panel(Cloud& cloud, const Rigid3& lidar_from_panel, const Eigen::Vector2d& size_m,
                      double points_per_m2, double noise_m, Random& random) {
  const int count = static_cast<int>(size_m.prod() * points_per_m2);
  for (int i = 0; i < count; ++i) {
    const double x = size_m.x() * random.uniform(-0.5, 0.5);
    const double y = size_m.y() * random.uniform(-0.5, 0.5);
    const double z = noise_m * random.normal();
    cloud.points_m.push_back((lidar_from_panel * Eigen::Vector3d(x, y, z)).cast<float>());
    cloud.intensity.push_back(100.0F);
  }
}

/// An upright panel `distance_m` ahead, its middle at height `height_m`, turned about the vertical.
inline Rigid3 upright(double distance_m, double side_m, double height_m, double turn_rad) {
  Eigen::Matrix3d facing;  // x to the LiDAR's right, y up, z towards the LiDAR.
  facing.col(0) = Eigen::Vector3d(0, -1, 0);
  facing.col(1) = Eigen::Vector3d(0, 0, 1);
  facing.col(2) = Eigen::Vector3d(-1, 0, 0);
  return {so3_exp({0, 0, turn_rad}) * Eigen::Quaterniond(facing), {distance_m, side_m, height_m}};
}

/// Floor, one wall ahead and one at the side.
inline void add_room(Cloud& cloud, double floor_m, Random& random) {
  add_panel(cloud, {Eigen::Quaterniond::Identity(), {3.0, 0.0, floor_m}}, {5.0, 6.0}, 3000, 0.004,
            random);
  add_panel(cloud, upright(5.5, 0.0, floor_m + 1.5, 0.0), {6.0, 3.0}, 3000, 0.004, random);
  add_panel(cloud, upright(3.0, 3.0, floor_m + 1.5, 1.5707963), {5.0, 3.0}, 3000, 0.004, random);
}

}  // namespace lvcalib::test
