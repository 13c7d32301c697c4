// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class BoundaryRangePull final : public CatalogueEffect {
 public:
  BoundaryRangePull()
      : CatalogueEffect(
            {.id = "boundary_range_pull",
             .group = "LiDAR range",
             .title = "Range pull at edges",
             .physics = "Where a beam is cut by an edge, its energy comes from one side of the "
                        "footprint, which on a slanted board lies nearer or farther; 1 is "
                        "what the power alone does in every scan.",
             .formula = "dr = sin θ cos(ψ-α) (σ/cos θ)² I'(d)/I(d)",
             .source = "derived; compare Laconte 2019",
             .discriminating_pose = "a board turned beyond 40 degrees",
             .needs = {.circles = true, .intensity = true}},
            {{.name = "a", .unit = "1", .size_of_interest = 2.0, .prior_sigma = 3.0}}) {}

  void lidar(const BeamPoint& beam, const MeasurementTable& table, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    by[0] = edge_pull(beam, table) * beam.direction;
  }
};

}  // namespace

EffectPtr make_boundary_range_pull() {
  return std::make_shared<BoundaryRangePull>();
}

}  // namespace lvcalib
