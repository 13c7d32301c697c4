// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include <Eigen/Core>

#include "base/rigid3.h"
#include "model/measurement_table.h"

namespace lvcalib {

/// The clock of scene number k of so many: 0…1 in their order.
inline double scene_clock(std::size_t k, std::size_t scenes) {
  return static_cast<double>(k) / std::max(1.0, static_cast<double>(scenes) - 1.0);
}

/// Ray–board geometry of one scene at one state.
class SceneGeometry {
 public:
  SceneGeometry(const Rigid3& camera_from_lidar, const Rigid3& camera_from_board);

  [[nodiscard]] const Rigid3& lidar_from_board() const { return lidar_from_board_; }
  [[nodiscard]] const Eigen::Vector3d& normal() const { return normal_; }
  /// Distance along a unit ray to the board's plane; nothing for rays along it or away from it.
  [[nodiscard]] std::optional<double> range_m(const Eigen::Vector3d& direction) const;
  /// Board coordinates of a LiDAR point in the plane.
  [[nodiscard]] Eigen::Vector2d board_m(const Eigen::Vector3d& point_m) const;

  /// Row vector a of a range measurement: a displacement Δp of the measured point, or of the
  /// board's material there, moves measured minus predicted range by a·Δp. a = n/(n·dir).
  [[nodiscard]] Eigen::Vector3d range_row(const Eigen::Vector3d& direction) const;
  /// The same for the distance of an edge point along the unit vector `outward` (LiDAR frame, in
  /// the plane): what happens along the ray does not count.
  [[nodiscard]] Eigen::Vector3d edge_row(const Eigen::Vector3d& direction,
                                         const Eigen::Vector3d& outward) const;

  /// Derivative by the left perturbation of T_camera_board from that by the one of T_lidar_board;
  /// that by T_camera_lidar is its negative.
  [[nodiscard]] Vector6d by_camera_pose(const Vector6d& by_lidar_pose) const {
    return lidar_by_camera_.transpose() * by_lidar_pose;
  }

  /// Fills direction, range, angles, board point, incidence and slope of a beam.
  [[nodiscard]] bool describe(const Eigen::Vector3d& direction, BeamPoint& beam) const;

  /// Fills what a scene says of the beam towards the board's middle, given in the board's frame.
  void tell_middle(const Eigen::Vector2d& middle_m, TableScene& scene) const;

 private:
  Rigid3 lidar_from_board_;
  Matrix6d lidar_by_camera_;  // adjoint of T_lidar_camera
  Eigen::Vector3d normal_;
  double offset_m_ = 0.0;  // n·p of the plane
};

}  // namespace lvcalib
