// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QRgb>
#include <span>

namespace lvcalib::widgets {

/// Which colours stand for numbers.
enum class ColorMap {
  kSequential,  ///< Dark blue to yellow, evenly growing lightness, safe for colour-blind eyes.
  kDiverging,   ///< Blue below zero, near-white at zero, red above.
};

/// Colour of a share 0…1 of the range; values outside take the end's colour, NaN is grey.
QRgb map_color(ColorMap map, double share);

/// A range of values, with its colours.
struct ColorScale {
  ColorMap map = ColorMap::kSequential;
  double low = 0.0;
  double high = 1.0;
  [[nodiscard]] QRgb color(double value) const;
};

/// A scale over the central 96 % of the values, so that single outliers do not flatten it; a
/// diverging one is symmetric about zero. At most `samples` values are looked at.
ColorScale scale_for(std::span<const float> values, ColorMap map, std::size_t samples = 20'000);

}  // namespace lvcalib::widgets
