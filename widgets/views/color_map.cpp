// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/color_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/statistics.h"

namespace lvcalib::widgets {
namespace {

struct Stop {
  double red, green, blue;
};

// Anchors at equal distances; in between colours are interpolated.
constexpr std::array<Stop, 6> kSequential{
    {{68, 13, 96}, {60, 77, 138}, {38, 130, 142}, {48, 180, 122}, {152, 216, 62}, {250, 231, 60}}};
constexpr std::array<Stop, 5> kDiverging{
    {{33, 82, 170}, {120, 170, 220}, {225, 225, 225}, {235, 145, 110}, {178, 24, 43}}};

constexpr int kTableSize = 256;

template <std::size_t N>
std::array<QRgb, kTableSize> make_table(const std::array<Stop, N>& stops) {
  std::array<QRgb, kTableSize> table{};
  for (int i = 0; i < kTableSize; ++i) {
    const double place = static_cast<double>(i) / (kTableSize - 1) * static_cast<double>(N - 1);
    const auto k = std::min(static_cast<std::size_t>(place), N - 2);
    const double t = place - static_cast<double>(k);
    const auto mix = [t](double a, double b) { return static_cast<int>(a + t * (b - a) + 0.5); };
    table[static_cast<std::size_t>(i)] =
        qRgb(mix(stops[k].red, stops[k + 1].red), mix(stops[k].green, stops[k + 1].green),
             mix(stops[k].blue, stops[k + 1].blue));
  }
  return table;
}

}  // namespace

QRgb map_color(ColorMap map, double share) {
  static const auto sequential = make_table(kSequential);
  static const auto diverging = make_table(kDiverging);
  if (std::isnan(share)) return qRgb(128, 128, 128);
  const double clamped = std::clamp(share, 0.0, 1.0);
  const auto index = static_cast<std::size_t>(std::lround(clamped * (kTableSize - 1)));
  return map == ColorMap::kSequential ? sequential[index] : diverging[index];
}

QRgb ColorScale::color(double value) const {
  const double width = high - low;
  return map_color(map, width > 0 ? (value - low) / width : value - low + 0.5);
}

ColorScale scale_for(std::span<const float> values, ColorMap map, std::size_t samples) {
  std::vector<double> seen;
  const std::size_t step =
      std::max<std::size_t>(1, values.size() / std::max<std::size_t>(1, samples));
  for (std::size_t i = 0; i < values.size(); i += step) {
    if (std::isfinite(values[i])) seen.push_back(static_cast<double>(values[i]));
  }
  ColorScale scale;
  scale.map = map;
  if (seen.empty()) return scale;
  if (map == ColorMap::kDiverging) {
    for (double& v : seen) v = std::abs(v);
    scale.high = std::max(quantile(std::move(seen), 0.96), 1e-12);
    scale.low = -scale.high;
    return scale;
  }
  scale.low = quantile(seen, 0.02);
  scale.high = quantile(std::move(seen), 0.98);
  return scale;
}

}  // namespace lvcalib::widgets
