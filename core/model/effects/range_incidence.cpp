// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class RangeIncidence final : public CatalogueEffect {
 public:
  RangeIncidence()
      : CatalogueEffect(
            {.id = "range_incidence",
             .group = "LiDAR range",
             .title = "Range error with incidence",
             .physics = "The footprint stretches on a slanted surface and the echo with it.",
             .formula = "dr = a (sec θ - 1)",
             .source = "Soudarissanane 2009; Zámečníková 2015",
             .discriminating_pose = "a board turned beyond 50 degrees",
             .needs = {}},
            {{.name = "a",
              .unit = "mm",
              .unit_in_si = 1e-3,
              .size_of_interest = 2e-3,
              .prior_sigma = 0.05}}) {}

  void lidar(const BeamPoint& beam, const MeasurementTable& /*table*/, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    by[0] = (1.0 / std::cos(beam.incidence_rad) - 1.0) * beam.direction;
  }
};

}  // namespace

EffectPtr make_range_incidence() {
  return std::make_shared<RangeIncidence>();
}

}  // namespace lvcalib
