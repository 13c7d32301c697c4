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
                         .discriminating_pose = "measure a printed circle with a caliper",
                         .needs = {.circles = true, .intensity = true}},
                        {{.name = "g",
                          .unit = "mm",
                          .unit_in_si = 1e-3,
                          .size_of_interest = 0.3e-3,
                          .prior_sigma = 0.01}}) {}

  // The LiDAR alone shows it: the fit of a tag's corners has a coefficient of its own for ink that
  // moves all edges to one side.
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
