// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class InkGain final : public CatalogueEffect {
 public:
  InkGain()
      : CatalogueEffect({.id = "ink_gain",
                         .group = "board",
                         .title = "Ink gain",
                         .physics = "Ink spreads, so that every black edge moves outwards.",
                         .formula = "edges move out by g",
                         .source = "ISO 12647 dot gain",
                         .breaker = "measure a printed circle and tag with a caliper",
                         .needs = {.tags = true}},
                        {{"g", "mm", 1e-3, 0.1e-3, 0.01}}) {}

  void board(const PrintPoint& point, const Target& /*target*/, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    // A corner moves outwards along both of its edges.
    by[0].head<2>() = point.from_tag_m.cwiseSign();
  }

  void edge(const BoundaryRow& /*row*/, const MeasurementTable& /*table*/, double /*shape*/,
            std::span<double> by) const override {
    by[0] = 1.0;
  }
};

}  // namespace

EffectPtr make_ink_gain() {
  return std::make_shared<InkGain>();
}

}  // namespace lvcalib
