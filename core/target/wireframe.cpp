// SPDX-License-Identifier: BSD-3-Clause
#include "target/wireframe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lvcalib {

BoardWireframe board_wireframe(const Target& target, const Rigid3& frame_from_board, int segments) {
  const int side_segments = std::max(segments, 1);
  const int circle_segments = std::max(segments, 3);
  const auto placed = [&](double x, double y) {
    return Eigen::Vector3d(frame_from_board * Eigen::Vector3d(x, y, 0.0));
  };
  BoardWireframe wire;
  const BoardOutline outline = target.outline();
  const Eigen::Vector2d a = outline.lower_left_m;
  const Eigen::Vector2d b = outline.upper_right_m;
  const Eigen::Vector2d corners[] = {a, {b.x(), a.y()}, b, {a.x(), b.y()}, a};
  for (int side = 0; side < 4; ++side) {
    for (int k = 0; k < side_segments; ++k) {
      const double share = static_cast<double>(k) / side_segments;
      const Eigen::Vector2d p = corners[side] + share * (corners[side + 1] - corners[side]);
      wire.outline_m.push_back(placed(p.x(), p.y()));
    }
  }
  if (target.has_tags()) {
    for (const TargetTag& tag : target.tags()) {
      BoardWireframe::Shape shape{tag.id, {}};
      for (const Eigen::Vector2d& p : target.tag_corners_m(tag)) {
        shape.points_m.push_back(placed(p.x(), p.y()));
      }
      wire.tags.push_back(std::move(shape));
    }
  }
  for (const TargetNode& node : target.nodes()) {
    BoardWireframe::Shape shape{node.id, {}};
    for (int k = 0; k < circle_segments; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / circle_segments;
      shape.points_m.push_back(
          placed(node.center_m.x() + target.circle_radius_m * std::cos(angle),
                 node.center_m.y() + target.circle_radius_m * std::sin(angle)));
    }
    wire.circles.push_back(std::move(shape));
  }
  return wire;
}

}  // namespace lvcalib
