// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
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
  double outside = 0.0;  ///< Share of the points that lie beyond a rectangle of the board's size.
};

/// In every direction the board's size is put where it holds most points, and a rectangle drawn
/// about those. Of the rectangles not much larger than the smallest one, that whose sides come
/// closest to `size_m` (width, height). So what is on one plane with the board and narrow, its
/// stand, does not count.
OutlineFit fit_outline(const std::vector<PlanarSample>& samples, const Eigen::Vector2d& size_m);

/// Board poses by outline alone, in every symmetric assignment; none if the patch's sides differ
/// from the board's by more than a quarter, or more than a seventh of its points lie beyond.
/// `width`: where the board's width points (LiDAR frame), if that is known; of few lines a board
/// that stands askew cannot be told from one that does not.
std::vector<PatternMatch> outline_poses(const VoxelCloud& cloud, const PlanarPatch& patch,
                                        const Target& target,
                                        const std::optional<Eigen::Vector3d>& width = {});

}  // namespace lvcalib
