// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class FootprintOffset final : public CatalogueEffect {
 public:
  FootprintOffset()
      : CatalogueEffect(
            {.id = "footprint_offset",
             .group = "beam",
             .title = "Offset of the receiver's view",
             .physics = "The intensity is collected beside the reported direction.",
             .formula = "dd = r (βh cos ψ' + βv sin ψ'), in the board: over cos θ up the slope",
             .source = "derived",
             .discriminating_pose = "boards near and far, strongly turned",
             .needs = {.circles = true, .intensity = true}},
            alike({.name = "βh",
                   .unit = "mrad",
                   .unit_in_si = 1e-3,
                   .size_of_interest = 0.3e-3,
                   .prior_sigma = 0.02},
                  {"βv"})) {}

  void spot(const BeamPoint& beam, const MeasurementTable& /*table*/, double /*shape*/,
            std::span<Eigen::Vector3d> by) const override {
    const AngleAxes axes = angle_axes(beam);
    by[0] = axes.azimuth_m;
    by[1] = axes.elevation_m;
  }
};

}  // namespace

EffectPtr make_footprint_offset() {
  return std::make_shared<FootprintOffset>();
}

}  // namespace lvcalib
