// SPDX-License-Identifier: BSD-3-Clause
#include "model/transition_width.h"

#include <algorithm>
#include <cmath>

namespace lvcalib {

double transition_along(const BoardRefinement& refinement, const Rigid3& lidar_from_board,
                        double psi_rad) {
  const Eigen::Vector3d along =
      lidar_from_board.rotation * Eigen::Vector3d(std::cos(psi_rad), std::sin(psi_rad), 0.0);
  const Eigen::Vector2d uv(refinement.plane.axis_u.dot(along), refinement.plane.axis_v.dot(along));
  return std::sqrt(std::max(0.0, uv.dot(refinement.footprint_m2 * uv)));
}

double curvature_along(const BoardRefinement& refinement, double transition_m, double radius_m) {
  const double across = transition_m * transition_m;
  if (!(across > 0.0)) return 0.0;
  return -std::max(0.0, refinement.footprint_m2.determinant()) / across / (2.0 * radius_m);
}

}  // namespace lvcalib
