// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/color_bar.h"

#include <gtest/gtest.h>

#include "widgets/views/plots_test.h"

namespace lvcalib::widgets::color_bar_test {
namespace {

TEST(ColorBar, ShowsTheWholeScaleFromBelowUpwards) {
  ColorBar bar;
  ColorScale scale;
  scale.low = -3.0;
  scale.high = 17.0;
  bar.setScale(scale, "range (m)");
  bar.resize(bar.sizeHint().width(), 300);
  EXPECT_TRUE(test::shows(bar, QColor::fromRgb(scale.color(-3.0))));
  EXPECT_TRUE(test::shows(bar, QColor::fromRgb(scale.color(17.0))));
  const QImage image = bar.grab().toImage();
  const QRgb low = image.pixel(12, 280);
  const QRgb high = image.pixel(12, 20);
  EXPECT_GT(qGreen(high), qGreen(low));
}

TEST(ColorBar, NameOnlyIsNarrower) {
  ColorBar bar;
  bar.setScale({}, "x");
  const int wide = bar.sizeHint().width();
  bar.setNameOnly("camera colour");
  EXPECT_LT(bar.sizeHint().width(), wide);
}

TEST(ColorBar, OddScalesAreDrawn) {
  ColorBar bar;
  bar.resize(80, 200);
  for (const auto& [low, high] : {std::pair{5.0, 5.0}, {0.0, 1e-9}, {-1e12, 1e12}, {3.0, 1.0}}) {
    ColorScale scale;
    scale.low = low;
    scale.high = high;
    bar.setScale(scale, "odd");
    EXPECT_FALSE(bar.grab().isNull());
  }
}

}  // namespace
}  // namespace lvcalib::widgets::color_bar_test
