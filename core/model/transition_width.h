// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/rigid3.h"
#include "refinement/board_refinement.h"

namespace lvcalib {

/// Width (m, one σ) of the transition along the direction ψ of the board, from the footprint that
/// a refinement measured; zero where it measured none.
double transition_along(const BoardRefinement& refinement, const Rigid3& lidar_from_board,
                        double psi_rad);

/// Mid-level shift (m, outward) at a circle's edge by the footprint that the transitions show: its
/// variance along the edge, given none across, over twice the radius, negative.
double curvature_along(const BoardRefinement& refinement, double transition_m, double radius_m);

}  // namespace lvcalib
