// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "base/progress.h"
#include "cloud/cloud.h"

namespace lvcalib {

struct LocalNormalOptions {
  double patch_rad = 0.05;  ///< Width of a patch over its range.
  int min_points = 12;      ///< In a patch.
  double flatness = 0.15;   ///< Largest ratio of a patch's least to its middle variance.
};

/// Unit normals (towards the LiDAR) of the flat patches about the points of a cloud; zero where a
/// point is no return, or its neighbourhood is not flat or too sparse. Patches grow with the range,
/// so that the noise of near and far points counts alike. One pass over the points and a grid whose
/// size is that of the occupied space. Empty if stopped.
std::vector<Eigen::Vector3f> local_normals(const Cloud& cloud, const LocalNormalOptions& options,
                                           const RunContext& context);

}  // namespace lvcalib
