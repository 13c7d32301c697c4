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

class BeamBlur final : public CatalogueEffect {
 public:
  BeamBlur()
      : CatalogueEffect({.id = "beam_blur",
                         .group = "beam",
                         .title = "Beam blur",
                         .physics = "Footprint and pointing jitter blur the print.",
                         .formula = "A = print * N(0, S)",
                         .source = "derived",
                         .breaker = "boards at near and far distance",
                         .needs = {.intensity = true}},
                        {blur("horizontal"), blur("mixed"), blur("vertical")}) {}

  void blur(const BeamPoint& /*beam*/, const MeasurementTable& /*table*/, double /*shape*/,
            std::span<Eigen::Vector3d> by) const override {
    for (std::size_t k = 0; k < 3; ++k) by[k] = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(k));
  }

 private:
  // No LiDAR's beam is wider than a hundredth of a radian.
  static EffectParameter blur(const char* name) {
    return {
        .name = name, .unit = "mrad²", .unit_in_si = 1e-6, .material = 1e-7, .prior_sigma = 1e-4};
  }
};

}  // namespace

EffectPtr beam_blur() {
  return std::make_shared<BeamBlur>();
}

EffectPtr natural_footprint() {
  return std::make_shared<NaturalFootprint>();
}

bool describes_footprint(const std::string& effect_id) {
  return effect_id == "beam_divergence" || effect_id == "footprint_anisotropy";
}

}  // namespace lvcalib
