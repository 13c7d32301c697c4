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
                         .physics = "A wide beam blurs every edge of the print, the more the "
                                    "farther.",
                         .formula = "A = print * N(0, S), S += γ² I",
                         .source = "Livox Avia manual; Laconte 2019",
                         .discriminating_pose = "circles at near and far distance",
                         .needs = {.circles = true, .intensity = true}},
                        {{.name = "γ²",
                          .unit = "mrad²",
                          .unit_in_si = 1e-6,
                          .size_of_interest = 4e-6,
                          .prior_sigma = 1e-4,
                          .lowest = 0.0}}) {}

  void blur(const BeamPoint& /*beam*/, const MeasurementTable& /*table*/, double /*shape*/,
            std::span<Eigen::Vector3d> by) const override {
    by[0] << 1.0, 0.0, 1.0;
  }
  [[nodiscard]] bool is_in_base_model() const override { return true; }
};

}  // namespace

EffectPtr make_beam_divergence() {
  return std::make_shared<BeamDivergence>();
}

}  // namespace lvcalib
