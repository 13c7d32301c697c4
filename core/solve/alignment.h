// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "base/rigid3.h"

namespace lvcalib {

/// A point known in two frames.
struct PointPair {
  Eigen::Vector3d target_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d source_m = Eigen::Vector3d::Zero();
  double weight = 1.0;
};

/// target_from_source by argmin Σ w ‖target − T·source‖² in closed form (Arun et al. 1987; sign by
/// Umeyama 1991). Identity for no pairs; with fewer than three not on a line the rotation about
/// that line is arbitrary.
Rigid3 align_points(const std::vector<PointPair>& pairs);

}  // namespace lvcalib
