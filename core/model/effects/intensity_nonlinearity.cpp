// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

// It moves edges: at tenfold contrast and a transition of 3 mm, 0.2 moves them by 0.36 mm, about
// the ink gain of interest.
constexpr double kSizeOfInterest = 0.2;

class IntensityNonlinearity final : public CatalogueEffect {
 public:
  IntensityNonlinearity()
      : CatalogueEffect(
            {.id = "intensity_nonlinearity",
             .group = "radiometry",
             .title = "Non-linear intensity",
             .physics =
                 "The receiver compresses strong echoes, so that the middle between black and "
                 "white is reached off the edge.",
             .formula = "I = (true I)^(1+g): the mid-level crossing of edges moves",
             .source = "Mitka and Klapa 2025",
             .discriminating_pose = "prints of several greys, or a reflectance chart",
             .needs = {.circles = true, .intensity = true}},
            {{.name = "g", .unit = "1", .size_of_interest = kSizeOfInterest, .prior_sigma = 2.0}}) {
  }

  [[nodiscard]] bool follows_white() const override { return true; }

  // Levels of plain print tell nothing: every scene has its own, and a power of them is a level
  // too. The middle between two transformed levels is not the transformed middle. With the dark
  // level as unit: I = m where m = (1+c)/2, dI/dg = (c ln c)/2 - m ln m, and dd = dI (σ √2π)/(c-1).
  // Where every return is predicted the whole transition tells instead, see intensity().
  // With white as unit: dI/dg = I ln I, less the straight line between the levels, which the levels
  // take up. I = e^(-Dc), D the darkness and c the logarithm of the contrast.
  void intensity(const IntensityRow& row, const MeasurementTable& table, double /*shape*/,
                 std::span<double> by) const override {
    const double log_contrast = table.log_contrast;
    if (!(log_contrast > 0.0)) return;
    const double level = std::exp(-row.beam.darkness * log_contrast);
    const double black = std::exp(-log_contrast);
    const double share = (1.0 - level) / (1.0 - black);  // of black
    if (share < 0.0 || share > 1.0) return;
    by[0] = std::log(level) + share * black * log_contrast / level;
  }
};

}  // namespace

EffectPtr make_intensity_nonlinearity() {
  return std::make_shared<IntensityNonlinearity>();
}

}  // namespace lvcalib
