// SPDX-License-Identifier: BSD-3-Clause
#include "solve/scene_residuals.h"

namespace lvcalib {

std::vector<CornerResidual> corner_residuals(const SceneObservations& scene, const Camera& camera,
                                             const Rigid3& camera_from_board,
                                             const std::vector<bool>& mask) {
  std::vector<CornerResidual> out;
  out.reserve(scene.corners.size());
  for (std::size_t k = 0; k < scene.corners.size(); ++k) {
    const CornerObservation& c = scene.corners[k];
    CornerResidual r{c.feature_id, c.corner, Eigen::Vector2d::Zero(), mask[k]};
    const auto p =
        camera.project(camera_from_board * Eigen::Vector3d(c.board_m.x(), c.board_m.y(), 0.0));
    if (p) {
      r.residual_px = c.pixel - *p;
    } else {
      r.used = false;
    }
    out.push_back(r);
  }
  return out;
}

std::vector<NodeResidual> node_residuals(const SceneObservations& scene,
                                         const Rigid3& camera_from_lidar,
                                         const Rigid3& camera_from_board,
                                         const std::vector<bool>& mask) {
  std::vector<NodeResidual> out;
  out.reserve(scene.nodes.size());
  const Rigid3 board_from_lidar = camera_from_board.inverse() * camera_from_lidar;
  for (std::size_t k = 0; k < scene.nodes.size(); ++k) {
    const RefinedNode& node = scene.nodes[k];
    const Eigen::Vector3d residual = board_from_lidar * node.center_lidar_m -
                                     Eigen::Vector3d(node.board_m.x(), node.board_m.y(), 0.0);
    out.push_back({node.id, residual, mask[k]});
  }
  return out;
}

std::vector<double> plane_heights_mm(const SceneObservations& scene, const Target& target,
                                     const Rigid3& camera_from_lidar,
                                     const Rigid3& camera_from_board) {
  const Rigid3 lidar_from_board = camera_from_lidar.inverse() * camera_from_board;
  const Eigen::Matrix3d probes = plane_probe_points(target);
  std::vector<double> out;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d p = lidar_from_board * Eigen::Vector3d(probes.col(k));
    out.push_back(1e3 * scene.plane.normal.dot(p - scene.plane.center_m));
  }
  return out;
}

}  // namespace lvcalib
