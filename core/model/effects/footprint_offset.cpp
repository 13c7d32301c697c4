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
             .breaker = "boards near and far, strongly turned",
             .needs = {.circles = true, .intensity = true}},
            {{"βh", "mrad", 1e-3, 0.3e-3, 0.02}, {"βv", "mrad", 1e-3, 0.3e-3, 0.02}}) {}

  void edge(const BoundaryRow& row, const MeasurementTable& /*table*/, double /*shape*/,
            std::span<double> by) const override {
    by[0] = row.edge_normal_rad.x();
    by[1] = row.edge_normal_rad.y();
  }
};

}  // namespace

EffectPtr make_footprint_offset() {
  return std::make_shared<FootprintOffset>();
}

}  // namespace lvcalib
