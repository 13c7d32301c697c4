// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class IntensityNonlinearity final : public CatalogueEffect {
 public:
  IntensityNonlinearity()
      : CatalogueEffect(
            {.id = "intensity_nonlinearity",
             .group = "radiometry",
             .title = "Non-linear intensity",
             .physics = "The receiver compresses strong echoes: black and white do not change by "
                        "the same factor.",
             .formula = "ln I = g ln(true I), seen as a contrast that changes with the geometry",
             .source = "Mitka and Klapa 2025",
             .breaker = "boards at several distances",
             .needs = {.intensity = true}},
            {{"g", "1", 1.0, 0.1, 2.0}}) {}

  void intensity(const IntensityRow& row, const MeasurementTable& /*table*/, double /*shape*/,
                 std::span<double> by) const override {
    const double weaker =
        std::log(std::cos(row.beam.incidence_rad)) - 2.0 * std::log(row.beam.range_m);
    by[0] = row.print == Print::kWhite ? 0.0 : weaker;
  }
};

}  // namespace

EffectPtr make_intensity_nonlinearity() {
  return std::make_shared<IntensityNonlinearity>();
}

}  // namespace lvcalib
