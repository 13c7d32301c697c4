// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class IntensityGeometry final : public CatalogueEffect {
 public:
  IntensityGeometry()
      : CatalogueEffect(
            {.id = "intensity_geometry",
             .group = "radiometry",
             .title = "Intensity with range and incidence",
             .physics =
                 "Less light returns from far and slanted surfaces than the sensor corrects for.",
             .formula = "ln I = n ln cos θ - p ln r",
             .source = "Laconte 2019; Livox manuals",
             .breaker = "boards at several distances and angles",
             .needs = {.intensity = true}},
            {{"n", "1", 1.0, 0.3, 3.0}, {"p", "1", 1.0, 0.3, 4.0}}) {}

  void intensity(const IntensityRow& row, const MeasurementTable& /*table*/, double /*shape*/,
                 std::span<double> by) const override {
    by[0] = std::log(std::cos(row.beam.incidence_rad));
    by[1] = -std::log(row.beam.range_m);
  }
};

}  // namespace

EffectPtr make_intensity_geometry() {
  return std::make_shared<IntensityGeometry>();
}

}  // namespace lvcalib
