// SPDX-License-Identifier: BSD-3-Clause
#include "model/scene_geometry.h"

#include <algorithm>
#include <cmath>

namespace lvcalib {

SceneGeometry::SceneGeometry(const Rigid3& camera_from_lidar, const Rigid3& camera_from_board)
    : lidar_from_board_(camera_from_lidar.inverse() * camera_from_board),
      lidar_by_camera_(camera_from_lidar.inverse().adjoint()),
      normal_(lidar_from_board_.rotation * Eigen::Vector3d::UnitZ()),
      offset_m_(normal_.dot(lidar_from_board_.translation)) {}

std::optional<double> SceneGeometry::range_m(const Eigen::Vector3d& direction) const {
  constexpr double kGrazing = 0.02;  // beyond 88.9 degrees nothing is measured
  const double along = normal_.dot(direction);
  if (std::abs(along) < kGrazing) return std::nullopt;
  const double range = offset_m_ / along;
  if (!(range > 0.0)) return std::nullopt;
  return range;
}

Eigen::Vector2d SceneGeometry::board_m(const Eigen::Vector3d& point_m) const {
  return (lidar_from_board_.rotation.conjugate() * (point_m - lidar_from_board_.translation))
      .head<2>();
}

Eigen::Vector3d SceneGeometry::range_row(const Eigen::Vector3d& direction) const {
  return normal_ / normal_.dot(direction);
}

Eigen::Vector3d SceneGeometry::edge_row(const Eigen::Vector3d& direction,
                                        const Eigen::Vector3d& outward) const {
  return outward - normal_ * (outward.dot(direction) / normal_.dot(direction));
}

bool SceneGeometry::describe(const Eigen::Vector3d& direction, BeamPoint& beam) const {
  const auto range = range_m(direction);
  if (!range) return false;
  beam.direction = direction;
  beam.range_m = *range;
  beam.azimuth_rad = std::atan2(direction.y(), direction.x());
  beam.elevation_rad = std::asin(std::clamp(direction.z(), -1.0, 1.0));
  beam.board_m = board_m(*range * direction);
  beam.incidence_rad = std::acos(std::min(1.0, std::abs(normal_.dot(direction))));
  // Moving along the board away from the foot of the LiDAR's normal the range grows.
  const Eigen::Vector3d in_board = lidar_from_board_.rotation.conjugate() * direction;
  beam.slope_rad = std::atan2(in_board.y(), in_board.x());
  return true;
}

void SceneGeometry::tell_middle(const Eigen::Vector2d& middle_m, TableScene& scene) const {
  const Eigen::Vector3d at = lidar_from_board_ * Eigen::Vector3d(middle_m.x(), middle_m.y(), 0.0);
  BeamPoint beam;
  if (!describe(at.normalized(), beam)) return;
  scene.middle_range_m = beam.range_m;
  scene.middle_incidence_rad = beam.incidence_rad;
}

}  // namespace lvcalib
