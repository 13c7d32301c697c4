// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/board_hits.h"

namespace lvcalib {

/// An angular bin about a circle's centre, board frame.
struct EdgeSector {
  double middle_rad = 0.0;
  double half_width_rad = 0.0;
};

/// Which points of a scene saw the edges of the circles, and how much each of them says about
/// where an edge is: the square of the transition's slope there over its noise.
class EdgeView {
 public:
  EdgeView(const std::vector<BoardHit>& hits, const std::vector<TargetNode>& nodes, double radius_m,
           const TransitionNoise& noise);

  /// Sets time, scan velocity and lines of an edge to the means over the points that tell of it.
  /// A point's own share of the edge's shift is what an effect of the scan moves.
  void describe(std::size_t node, const EdgeSector& sector, BoundaryRow& row) const;

 private:
  std::vector<std::vector<const BoardHit*>> by_node_;
  TransitionNoise noise_;
};

}  // namespace lvcalib
