// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/large_text.h"

#include <gtest/gtest.h>

namespace lvcalib::widgets::large_text_test {
namespace {

TEST(LargeText, LettersAreAsLargeAsFits) {
  LargeText text(60.0);
  text.resize(600, 200);
  text.show();
  text.setText("Next");
  EXPECT_EQ(text.points(), 60.0);
  text.setText(QString("word ").repeated(40));
  const double many = text.points();
  EXPECT_LT(many, 60.0);
  text.resize(1200, 400);
  EXPECT_GT(text.points(), 1.5 * many);
  // Nothing is cut off, and a single word is never broken.
  text.resize(200, 400);
  text.setText("Donaudampfschifffahrt");
  const QFontMetricsF metrics([&] {
    QFont font = text.font();
    font.setPointSizeF(text.points());
    return font;
  }());
  EXPECT_LE(metrics.horizontalAdvance(text.text()), 201.0);
}

TEST(LargeText, IsDrawnInItsColour) {
  LargeText text(60.0);
  text.resize(300, 100);
  text.setText("Next");
  text.setColor(Qt::red);
  const QImage picture = text.grab().toImage();
  int red = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x)
      red += picture.pixelColor(x, y) == QColor(Qt::red) ? 1 : 0;
  }
  EXPECT_GT(red, 50);
  EXPECT_EQ(text.accessibleName(), "Next");
}

}  // namespace
}  // namespace lvcalib::widgets::large_text_test
