// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "base/progress.h"
#include "cloud/plane.h"
#include "localization/voxel_cloud.h"

namespace lvcalib {

/// A connected flat piece of a scene.
struct PlanarPatch : PlaneFrame {
  double thickness_m = 0.0;  ///< Robust standard deviation about the plane.
  Eigen::Vector2d extent_m =
      Eigen::Vector2d::Zero();  ///< Sides of the smallest bounding rectangle, longer first.
  bool open = false;            ///< Goes on beyond the searched radius (a wall).
  std::vector<std::uint32_t> voxels;
};

/// How points of a plane hang together.
struct PatchConnection {
  double gap = 0.05;  ///< Cell side as a share of the board's shorter side; neighbours connect.
  bool cut_strips = false;  ///< Connections narrower than three cells do not count.
  /// Only about seeds whose patches so far are smaller than the board, and only patches that have
  /// grown: where the lines of a scanner lie this far apart, pieces of a board.
  bool grows_small = false;
};

struct PatchSearchOptions {
  double board_width_m = 0.9;
  double board_height_m = 0.9;
  /// Largest distance from the plane, 0: three times the measured noise of the scene's planes.
  double plane_tolerance_m = 0.0;
  /// Each way of connecting gives its own patches: fine cells part the board from neighbours and
  /// from floor and walls that its plane cuts; wide ones bridge the lines of a sparse scanner (the
  /// last: 2° apart, a board of 0.6 m at 4 m).
  std::vector<PatchConnection> connections = {
      {0.05, true, false}, {0.12, false, false}, {0.25, false, true}};
  double smallest_side =
      0.4;  ///< Patches with a shorter side than this share of the board's are left out.
};

/// Finds every flat patch that could hold the board: not smaller than a board that is partly cut
/// off, and (closed ones) not much larger. Deterministic.
std::vector<PlanarPatch> find_planar_patches(const VoxelCloud& cloud,
                                             const PatchSearchOptions& options,
                                             const RunContext& context);

/// An orthonormal in-plane basis for a unit normal, right-handed: u × v = normal.
void plane_basis(const Eigen::Vector3d& normal, Eigen::Vector3d& axis_u, Eigen::Vector3d& axis_v);

}  // namespace lvcalib
