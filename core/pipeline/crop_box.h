// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "base/error.h"
#include "cloud/cloud.h"

namespace lvcalib {

/// An oriented box in the LiDAR frame: lidar_from_box takes a point of the box frame, in which
/// the box spans ±half_size_m, to the LiDAR frame.
struct CropBox {
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();            ///< In the LiDAR frame.
  Eigen::Vector3d half_size_m = Eigen::Vector3d::Ones();         ///< Along the box's own axes; > 0.
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< Box axes in the LiDAR frame.

  /// Inside or on the surface.
  [[nodiscard]] bool contains(const Eigen::Vector3d& point_m) const;
  bool operator==(const CropBox& other) const;
};

/// kUsage if a number is not finite, a half size not positive or the rotation not a unit
/// quaternion (within 1e-3).
Status check(const CropBox& box);

/// The points of a cloud inside a box, in their order, with all their fields.
Cloud crop(const Cloud& cloud, const CropBox& box);

}  // namespace lvcalib
