// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include <Eigen/Core>

#include "cloud/cloud.h"

namespace lvcalib {

/// A plane in the LiDAR frame, with axes in it.
struct PlaneFrame {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< Unit, towards the LiDAR.
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();  ///< A point of the plane, amid the points.
  Eigen::Vector3d axis_u = Eigen::Vector3d::UnitX();
  Eigen::Vector3d axis_v = Eigen::Vector3d::UnitY();  ///< axis_u × axis_v = normal.

  [[nodiscard]] Eigen::Vector2d to_plane(const Eigen::Vector3d& point_m) const {
    const Eigen::Vector3d d = point_m - center_m;
    return {axis_u.dot(d), axis_v.dot(d)};
  }
  [[nodiscard]] Eigen::Vector3d to_lidar(const Eigen::Vector2d& uv_m) const {
    return center_m + uv_m.x() * axis_u + uv_m.y() * axis_v;
  }
  /// Axes in the plane turned by an angle from axis_u towards axis_v, and the normal:
  /// R_lidar_board.
  [[nodiscard]] Eigen::Matrix3d turned(double angle_rad) const;
};

/// A plane fitted to LiDAR points, with the covariance of its pose.
struct FittedPlane : PlaneFrame {
  /// Covariance of (height at center_m [m], slope along axis_u, slope along axis_v).
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  /// Robust standard deviation of the range residuals, per group of points (see fit_plane).
  std::array<double, 4> group_sigma_m{};
  double sigma_range_m = 0.0;  ///< The smallest of them that stands for a fair share of the points.
  std::size_t inliers = 0;
  /// Mean range residual of every group (robust) and its standard deviation; 0 for empty groups.
  std::array<double, 4> group_offset_m{};
  std::array<double, 4> group_offset_sigma_m{};

  /// Where the ray through a point meets the plane, in plane coordinates: free of range noise.
  [[nodiscard]] std::optional<Eigen::Vector2d> ray_hit(const Eigen::Vector3d& point_m) const;
  /// Measured minus predicted range of a point, in metres.
  [[nodiscard]] std::optional<double> range_residual_m(const Eigen::Vector3d& point_m) const;
};

/// Fits a plane so that the residuals along the rays are smallest (range noise, not perpendicular
/// distance), robustly (Tukey). `start` gives the first normal, centre and axis_u.
/// `groups` (empty, or one number 0 … 3 per point) parts points of different noise, as dark and
/// white print: each group's σ is measured and weighs its points.
/// Nothing with fewer than ten points or all of them on one line.
std::optional<FittedPlane> fit_plane(std::span<const Eigen::Vector3f> points_m,
                                     const FittedPlane& start,
                                     std::span<const std::uint8_t> groups = {});

/// Appends point i of `from` with all its fields to `to`.
void append_point(Cloud& to, const Cloud& from, std::size_t i);

}  // namespace lvcalib
