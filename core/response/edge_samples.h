// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "response/boundary_response.h"

namespace lvcalib {

/// The points of a scene near its refined circles, each with its signed distance and residuals.
/// Circles are the printed ones at the refined board pose; points far off the plane are left out.
std::vector<BoundarySample> collect_edge_samples(const ResponseInput& scene, const Target& target);

/// Judges every node by its samples (sorted by node), and marks the overlap samples of the used
/// ones. `shift_m` is the transition's δ.
std::vector<NodeResponse> judge_nodes(const BoardRefinement& refinement,
                                      std::vector<BoundarySample>& samples, double shift_m,
                                      const Target& target, const ResponseOptions& options);

/// Half-width of the overlap region in a sample's direction: `overlap_sigmas` widths, but no
/// farther than the circle reaches inwards and than outwards the print is clear of tags.
double overlap_half_width_m(const BoundarySample& sample, const Target& target,
                            const ResponseOptions& options);

/// Whether the tags about the circle are two widths away, so that their black does not mix in.
bool clear_of_tags(const BoundarySample& sample, const Target& target);

}  // namespace lvcalib
