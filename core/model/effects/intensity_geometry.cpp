// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

// Of more lines than this the gains would drown the two exponents in the test of all together.
constexpr std::size_t kMostLines = 16;

class IntensityGeometry final : public CatalogueEffect {
 public:
  IntensityGeometry()
      : CatalogueEffect(
            {.id = "intensity_geometry",
             .group = "radiometry",
             .title = "Intensity with range and incidence",
             .physics = "Less light returns from far and slanted surfaces than the sensor corrects "
                        "for, and every line has a gain of its own.",
             .formula = "ln I = n ln cos θ - p ln r + g(line)",
             .source = "Laconte 2019; Livox manuals",
             .discriminating_pose = "boards at several distances and angles",
             .needs = {.intensity = true}},
            {{.name = "n", .unit = "1", .size_of_interest = 0.3, .prior_sigma = 3.0},
             {.name = "p", .unit = "1", .size_of_interest = 0.3, .prior_sigma = 4.0}}) {}

  // Gains are those relative to the first line: what all have in common is the scenes' levels.
  [[nodiscard]] std::vector<EffectParameter> parameters(
      const MeasurementTable& table) const override {
    std::vector<EffectParameter> out = CatalogueEffect::parameters(table);
    const auto gains = one_per_line(
        table, {.name = "g", .unit = "1", .size_of_interest = 0.1, .prior_sigma = 1.0});
    if (gains.size() > 1 && gains.size() <= kMostLines)
      out.insert(out.end(), gains.begin() + 1, gains.end());
    return out;
  }

  void intensity(const IntensityRow& row, const MeasurementTable& table, double /*shape*/,
                 std::span<double> by) const override {
    // About the board's middle: what a scene has in common are its levels, and a product of two
    // unknowns would make the fit creep along a bent valley.
    const TableScene& scene = table.scenes[static_cast<std::size_t>(row.beam.scene)];
    by[0] = std::log(std::cos(row.beam.incidence_rad) / std::cos(scene.middle_incidence_rad));
    by[1] = -std::log(row.beam.range_m / scene.middle_range_m);
    const auto k = line_index(table, row.beam.line);
    if (k > 0 && k + 1 < by.size()) by[k + 1] = 1.0;
  }
};

}  // namespace

EffectPtr make_intensity_geometry() {
  return std::make_shared<IntensityGeometry>();
}

}  // namespace lvcalib
