// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class BeamDivergence final : public CatalogueEffect {
 public:
  BeamDivergence()
      : CatalogueEffect({.id = "beam_divergence",
                         .group = "beam",
                         .title = "Beam divergence",
                         .physics = "A wide footprint on a small circle moves the mid-level "
                                    "inwards, the more the farther.",
                         .formula = "dd = -σ²/2R, σ² = (γr)² (1 + tan²θ cos²(ψ-α))",
                         .source = "Livox Avia manual; Laconte 2019",
                         .breaker = "circles at near and far distance",
                         .needs = {.circles = true, .intensity = true}},
                        {{"γ²", "mrad²", 1e-6, 4e-6, 1e-4}}) {}

  void edge(const BoundaryRow& row, const MeasurementTable& /*table*/, double /*shape*/,
            std::span<double> by) const override {
    const double tilt =
        std::tan(row.beam.incidence_rad) * std::cos(row.psi_rad - row.beam.slope_rad);
    by[0] = -row.beam.range_m * row.beam.range_m * (1.0 + tilt * tilt) / (2.0 * row.radius_m);
  }
};

}  // namespace

EffectPtr make_beam_divergence() {
  return std::make_shared<BeamDivergence>();
}

}  // namespace lvcalib
