// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class Blooming final : public CatalogueEffect {
 public:
  Blooming()
      : CatalogueEffect(
            {.id = "blooming",
             .group = "beam",
             .title = "Blooming",
             .physics = "Bright print outshines its neighbourhood, so that edges move towards the "
                        "dark side, the more the higher the contrast.",
             .formula = "dd = -κ σ ln(µ_out/µ_in)",
             .source = "VLS-128 manual",
             .discriminating_pose =
                 "prints of two contrasts, or distances with different footprints",
             .needs = {.circles = true, .intensity = true}},
            {{.name = "κ",
              .unit = "1",
              .size_of_interest = 0.05,
              .prior_sigma = 1.0,
              .lowest = 0.0}}) {}

  void edge(const BoundaryRow& row, const MeasurementTable& /*table*/, double /*shape*/,
            std::span<double> by) const override {
    by[0] = -row.transition_m * row.log_contrast;
  }
};

}  // namespace

EffectPtr make_blooming() {
  return std::make_shared<Blooming>();
}

}  // namespace lvcalib
