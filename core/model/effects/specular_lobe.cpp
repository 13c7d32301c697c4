// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class SpecularLobe final : public CatalogueEffect {
 public:
  SpecularLobe()
      : CatalogueEffect({.id = "specular_lobe",
                         .group = "radiometry",
                         .title = "Specular lobe",
                         .physics = "Glossy print shines when the beam hits it squarely.",
                         .formula = "I += k exp(-θ²/2s²)",
                         .source = "Laconte 2019",
                         .discriminating_pose = "boards square to the beam beside turned ones",
                         .needs = {.intensity = true}},
                        {{.name = "k",
                          .unit = "1",
                          .size_of_interest = 0.1,
                          .prior_sigma = 5.0,
                          .lowest = 0.0}}) {}

  [[nodiscard]] std::vector<double> shapes(const MeasurementTable&) const override {
    return {0.05, 0.12, 0.25};
  }
  [[nodiscard]] std::string shape_name() const override { return "width s (rad)"; }

  void intensity(const IntensityRow& row, const MeasurementTable& table, double shape,
                 std::span<double> by) const override {
    const double lobe = std::exp(-0.5 * std::pow(row.beam.incidence_rad / shape, 2));
    // Relative to the white level: black print gains by its contrast more, a mixture by its own.
    by[0] = lobe * (table.print ? std::exp(row.beam.darkness * table.log_contrast)
                                : table.level_of(Print::kWhite) / table.level_of(row.print));
  }
};

}  // namespace

EffectPtr make_specular_lobe() {
  return std::make_shared<SpecularLobe>();
}

}  // namespace lvcalib
