// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "cloud/cloud.h"

namespace lvcalib {

/// Where a LiDAR looks, as far as its returns tell.
struct FieldOfView {
  /// Closed lines of unit directions: one about the view, or the lower and the upper border of a
  /// view all around.
  std::vector<std::vector<Eigen::Vector3d>> outlines;
  /// Four directions on each border, for lines from the origin.
  std::vector<Eigen::Vector3d> edges;
};

/// Of the directions of a cloud's points. Whether the view goes all around, and about which axis,
/// is seen from them: nothing depends on how the LiDAR's frame lies. Empty for an empty cloud.
FieldOfView field_of_view(const Cloud& cloud);

}  // namespace lvcalib
