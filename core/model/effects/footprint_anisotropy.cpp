// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class FootprintAnisotropy final : public CatalogueEffect {
 public:
  FootprintAnisotropy()
      : CatalogueEffect({.id = "footprint_anisotropy",
                         .group = "beam",
                         .title = "Elliptic footprint",
                         .physics = "The footprint is wider along one axis of the LiDAR.",
                         .formula = "A = print * N(0, S), S += ½ diag(a, −a), a = γh² − γv²",
                         .source = "Livox Avia manual",
                         .discriminating_pose = "circles far away",
                         .needs = {.circles = true, .intensity = true}},
                        {{.name = "a",
                          .unit = "mrad²",
                          .unit_in_si = 1e-6,
                          .size_of_interest = 4e-6,
                          .prior_sigma = 1e-4}}) {}

  void blur(const BeamPoint& /*beam*/, const MeasurementTable& /*table*/, double /*shape*/,
            std::span<Eigen::Vector3d> by) const override {
    by[0] << 0.5, 0.0, -0.5;
  }
  [[nodiscard]] bool is_in_base_model() const override { return true; }
};

}  // namespace

EffectPtr make_footprint_anisotropy() {
  return std::make_shared<FootprintAnisotropy>();
}

}  // namespace lvcalib
