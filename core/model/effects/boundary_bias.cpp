// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class BoundaryBias final : public CatalogueEffect {
 public:
  BoundaryBias()
      : CatalogueEffect(
            {.id = "boundary_bias",
             .group = "beam",
             .title = "Boundary bias",
             .physics =
                 "The mid-level crossing lies outside or inside the printed edge everywhere.",
             .formula = "dd = δ0",
             .source = "LV-Calib, boundary response",
             .discriminating_pose = "measure the printed circles: print growth looks the same",
             .needs = {.circles = true, .intensity = true}},
            {{.name = "δ0",
              .unit = "mm",
              .unit_in_si = 1e-3,
              .size_of_interest = 0.3e-3,
              .prior_sigma = 0.02}}) {}

  void edge(const BoundaryRow& /*row*/, const MeasurementTable& /*table*/, double /*shape*/,
            std::span<double> by) const override {
    by[0] = 1.0;
  }
};

}  // namespace

EffectPtr make_boundary_bias() {
  return std::make_shared<BoundaryBias>();
}

}  // namespace lvcalib
