// SPDX-License-Identifier: BSD-3-Clause
#include "refinement/node_samples.h"

#include <algorithm>
#include <cmath>

#include "refinement/node_fit.h"

namespace lvcalib {

NodeSampler::NodeSampler(const Cloud& board_points, const FittedPlane& plane,
                         const Target& target) {
  if (!target.has_circles()) return;
  const NodeWindow window = node_window(target);
  radius_m_ = window.radius_m;
  inside_m_ = window.inside_m;
  outside_m_ = window.outside_m;
  points_.reserve(board_points.size());
  for (std::size_t i = 0; i < board_points.size(); ++i) {
    const auto uv = plane.ray_hit(board_points.points_m[i].cast<double>());
    if (!uv) continue;
    const float intensity = board_points.has_intensity() ? board_points.intensity[i] : 0.0F;
    points_.push_back({uv->cast<float>(), intensity, static_cast<std::uint32_t>(i)});
  }
}

std::vector<NodeSample> NodeSampler::around(const Eigen::Vector2d& center_uv_m) const {
  std::vector<NodeSample> out;
  for (const Point& p : points_) {
    const Eigen::Vector2d d = p.uv_m.cast<double>() - center_uv_m;
    const double distance = d.norm() - radius_m_;
    if (distance < -inside_m_ || distance > outside_m_) continue;
    out.push_back({std::atan2(d.y(), d.x()), distance, p.intensity, p.index});
  }
  return out;
}

std::vector<std::uint32_t> boundary_points(const Cloud& board_points, const Target& target,
                                           const BoardRefinement& refinement) {
  const NodeSampler sampler(board_points, refinement.plane, target);
  std::vector<std::uint32_t> out;
  for (const RefinedNode& node : refinement.nodes) {
    for (const NodeSample& sample : sampler.around(node.center_uv_m)) out.push_back(sample.point);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::vector<CenterPath> center_paths(const BoardRefinement& refinement) {
  const Rigid3 board_from_lidar = refinement.lidar_from_board.inverse();
  const FittedPlane& plane = refinement.plane;
  Eigen::Matrix2d board_from_plane;
  const Eigen::Matrix3d R = board_from_lidar.rotation.toRotationMatrix();
  board_from_plane.col(0) = (R * plane.axis_u).head<2>();
  board_from_plane.col(1) = (R * plane.axis_v).head<2>();
  std::vector<CenterPath> paths;
  for (const RefinedNode& node : refinement.nodes) {
    const auto offset = [&](const Eigen::Vector2d& uv) {
      return Eigen::Vector2d((board_from_lidar * plane.to_lidar(uv)).head<2>() - node.board_m);
    };
    CenterPath path;
    path.id = node.id;
    path.valid = node.valid;
    path.board_m = node.board_m;
    for (const IterationRecord& iteration : refinement.history) {
      const auto record =
          std::find_if(iteration.nodes.begin(), iteration.nodes.end(),
                       [&](const NodeRecord& candidate) { return candidate.id == node.id; });
      if (record == iteration.nodes.end()) continue;
      path.predicted_m.push_back(offset(record->center_uv_m));
      path.measured_m.push_back(offset(record->center_uv_m + record->wave_m.head<2>()));
    }
    path.final_m = offset(node.center_uv_m);
    path.covariance_m2 = board_from_plane * node.covariance_m2 * board_from_plane.transpose();
    paths.push_back(std::move(path));
  }
  return paths;
}

}  // namespace lvcalib
