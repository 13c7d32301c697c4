// SPDX-License-Identifier: BSD-3-Clause
#include "model/beam_blur.h"

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class BeamBlur final : public CatalogueEffect {
 public:
  BeamBlur()
      : CatalogueEffect({.id = "beam_blur",
                         .group = "beam",
                         .title = "Beam blur",
                         .physics = "Footprint and pointing jitter blur the print.",
                         .formula = "A = print * N(0, S)",
                         .source = "derived",
                         .discriminating_pose = "boards at near and far distance",
                         .needs = {.intensity = true}},
                        {blur("horizontal"), blur("mixed"), blur("vertical")}) {}

  void blur(const BeamPoint& /*beam*/, const MeasurementTable& /*table*/, double /*shape*/,
            std::span<Eigen::Vector3d> by) const override {
    for (std::size_t k = 0; k < 3; ++k) by[k] = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(k));
  }

 private:
  // No LiDAR's beam is wider than a hundredth of a radian.
  static EffectParameter blur(const char* name) {
    return {.name = name,
            .unit = "mrad²",
            .unit_in_si = 1e-6,
            .size_of_interest = 1e-7,
            .prior_sigma = 1e-4};
  }
};

}  // namespace

EffectPtr beam_blur() {
  return std::make_shared<BeamBlur>();
}

Eigen::Index blur_place(const std::vector<EffectInUse>& in_use) {
  Eigen::Index at = 6;
  for (const EffectInUse& use : in_use) at += use.values.size();
  return at;
}

}  // namespace lvcalib
