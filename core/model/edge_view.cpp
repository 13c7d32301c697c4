// SPDX-License-Identifier: BSD-3-Clause
#include "model/edge_view.h"

#include <cmath>
#include <map>
#include <numbers>

namespace lvcalib {

EdgeView::EdgeView(const std::vector<BoardHit>& hits, const std::vector<TargetNode>& nodes,
                   double radius_m, const TransitionNoise& noise)
    : by_node_(nodes.size()), noise_(noise) {
  for (const BoardHit& hit : hits) {
    if (!hit.beam.edge) continue;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      if ((hit.beam.board_m - nodes[n].center_m).norm() < 2.0 * radius_m)
        by_node_[n].push_back(&hit);
    }
  }
}

void EdgeView::describe(std::size_t node, const EdgeSector& sector, BoundaryRow& row) const {
  BeamPoint& beam = row.beam;
  const double crossing = (beam.board_m - row.center_m).norm() - row.radius_m;
  std::map<int, double> lines;
  double sum = 0.0;
  double moving = 0.0;
  double time = 0.0;
  Eigen::Vector2d scan = Eigen::Vector2d::Zero();
  for (const BoardHit* hit : by_node_[node]) {
    const NearEdge& edge = *hit->beam.edge;
    const double turn = std::remainder(edge.psi_rad - sector.middle_rad, 2.0 * std::numbers::pi);
    if (std::abs(turn) > sector.half_width_rad) continue;
    const double weight = noise_.information((edge.distance_m - crossing) / edge.transition_m);
    sum += weight;
    time += weight * hit->beam.time_s;
    scan += weight * hit->beam.scan_rad_s;
    if (!hit->beam.scan_rad_s.isZero(0.0)) moving += weight;  // Zero: not known.
    lines[hit->beam.line] += weight;
  }
  if (!(sum > 0.0)) return;
  if (moving > 0.0) beam.scan_rad_s = scan / moving;
  beam.time_s = time / sum;
  double most = 0.0;
  for (const auto& [line, weight] : lines) {
    row.lines.push_back({line, weight / sum});
    if (weight <= most) continue;
    most = weight;
    beam.line = line;
  }
}

}  // namespace lvcalib
