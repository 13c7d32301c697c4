// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "localization/pattern_match.h"
#include "localization/planar_patch.h"
#include "target/target.h"

namespace lvcalib {

/// How a patch's bounding rectangle compares with the board's.
struct OutlineFit {
  double angle_rad = 0.0;  ///< Of the board's width against the plane's first axis.
  Eigen::Vector2d center_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d side_error_m = Eigen::Vector2d::Zero();  ///< Patch minus board, width and height.
};

/// Of the bounding rectangles not much larger than the smallest one, that whose sides come closest
/// to `size_m` (width, height).
OutlineFit fit_outline(const std::vector<PlanarSample>& samples, const Eigen::Vector2d& size_m);

/// Board poses by outline alone, in every symmetric assignment; none if the patch's sides differ
/// from the board's by more than a quarter.
std::vector<PatternMatch> outline_poses(const VoxelCloud& cloud, const PlanarPatch& patch,
                                        const Target& target);

}  // namespace lvcalib
