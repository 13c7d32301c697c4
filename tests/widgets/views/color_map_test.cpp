// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/color_map.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace lvcalib::widgets::color_map_test {
namespace {

double lightness(QRgb color) {
  return 0.2126 * qRed(color) + 0.7152 * qGreen(color) + 0.0722 * qBlue(color);
}

TEST(ColorMap, SequentialGrowsLighter) {
  double before = -1.0;
  for (int k = 0; k <= 50; ++k) {
    const double now = lightness(map_color(ColorMap::kSequential, k / 50.0));
    EXPECT_GT(now, before - 0.5) << k;
    before = now;
  }
}

TEST(ColorMap, DivergingIsNeutralInTheMiddle) {
  const QRgb middle = map_color(ColorMap::kDiverging, 0.5);
  EXPECT_NEAR(qRed(middle), qBlue(middle), 1);
  EXPECT_GT(qBlue(map_color(ColorMap::kDiverging, 0.0)),
            qRed(map_color(ColorMap::kDiverging, 0.0)));
  EXPECT_GT(qRed(map_color(ColorMap::kDiverging, 1.0)),
            qBlue(map_color(ColorMap::kDiverging, 1.0)));
}

TEST(ColorMap, OutsideTakesTheEndAndNanIsGrey) {
  EXPECT_EQ(map_color(ColorMap::kSequential, -3.0), map_color(ColorMap::kSequential, 0.0));
  EXPECT_EQ(map_color(ColorMap::kSequential, 9.0), map_color(ColorMap::kSequential, 1.0));
  const QRgb gray = map_color(ColorMap::kSequential, std::nan(""));
  EXPECT_EQ(qRed(gray), qGreen(gray));
  EXPECT_EQ(qRed(gray), qBlue(gray));
}

TEST(ColorScale, OutliersDoNotFlattenIt) {
  std::vector<float> values;
  for (int k = 0; k < 1000; ++k) values.push_back(static_cast<float>(k % 100));
  values[500] = 1e9F;
  values[501] = std::nanf("");
  const ColorScale scale = scale_for(values, ColorMap::kSequential);
  EXPECT_NEAR(scale.low, 2.0, 1.5);
  EXPECT_NEAR(scale.high, 98.0, 1.5);
  const ColorScale diverging = scale_for(values, ColorMap::kDiverging);
  EXPECT_EQ(diverging.low, -diverging.high);
}

TEST(ColorScale, OneValueAndNoneAreFine) {
  const std::vector<float> same(20, 7.0F);
  EXPECT_EQ(scale_for(same, ColorMap::kSequential).color(7.0),
            map_color(ColorMap::kSequential, 0.5));
  EXPECT_LT(scale_for({}, ColorMap::kSequential).low, scale_for({}, ColorMap::kSequential).high);
}

}  // namespace
}  // namespace lvcalib::widgets::color_map_test
