// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/plot_colors.h"

#include <cmath>

#include <gtest/gtest.h>

#include "widgets/views/plots_test.h"

namespace lvcalib::widgets::plot_colors_test {
namespace {

// Contrast ratio of WCAG 2.
double contrast(const QColor& a, const QColor& b) {
  const auto luminance = [](const QColor& c) {
    const auto linear = [](double v) {
      return v <= 0.03928 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(c.redF()) + 0.7152 * linear(c.greenF()) + 0.0722 * linear(c.blueF());
  };
  const double x = luminance(a);
  const double y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

TEST(PlotColors, WhatMattersStandsOutInLightAndDark) {
  for (const bool dark : {false, true}) {
    const PlotColors c = PlotColors::of(test::palette_of(dark));
    EXPECT_EQ(c.dark, dark);
    for (const QColor& color : {c.text, c.mark, c.refused, c.emphasis}) {
      EXPECT_GT(contrast(color, c.background), 4.5) << color.name().toStdString();
    }
    EXPECT_GT(contrast(c.fit, c.background), 3.0);
    for (int k = 0; k < 20; ++k) {
      EXPECT_GT(contrast(c.series(k), c.background), 2.5) << k;
      for (int other = 0; other < k; ++other) EXPECT_NE(c.series(k), c.series(other));
    }
    EXPECT_EQ(c.series(20), c.series(0));
  }
}

}  // namespace
}  // namespace lvcalib::widgets::plot_colors_test
