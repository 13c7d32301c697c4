// SPDX-License-Identifier: BSD-3-Clause
#include "model/natural_footprint.h"

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class NaturalFootprint final : public CatalogueEffect {
 public:
  NaturalFootprint()
      : CatalogueEffect({.id = "natural_footprint",
                         .group = "beam",
                         .title = "Natural footprint",
                         .physics = "The footprint that the transitions show, on a curved edge.",
                         .formula = "dd = -σ²/2R",
                         .source = "derived",
                         .breaker = "circles at near and far distance",
                         .needs = {.circles = true, .intensity = true}},
                        {{"c", "1", 1.0, 1.0, kNaturalSpread}}) {}

  void edge(const BoundaryRow& row, const MeasurementTable& /*table*/, double /*shape*/,
            std::span<double> by) const override {
    by[0] = row.curvature_m;
  }
};

}  // namespace

EffectPtr natural_footprint() {
  return std::make_shared<NaturalFootprint>();
}

bool describes_footprint(const std::string& effect_id) {
  return effect_id == "beam_divergence" || effect_id == "footprint_anisotropy";
}

}  // namespace lvcalib
