// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/swatch.h"

#include <QApplication>
#include <QLabel>
#include <cmath>

#include <gtest/gtest.h>

#include "style/theme.h"

namespace lvcalib::widgets::swatch_test {
namespace {

// Of WCAG 2: 1 for the same colour, 21 for black on white; 3 is asked of signs.
double contrast(const QColor& a, const QColor& b) {
  const auto luminance = [](const QColor& c) {
    const auto linear = [](double v) {
      return v <= 0.03928 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(c.redF()) + 0.7152 * linear(c.greenF()) + 0.0722 * linear(c.blueF());
  };
  const double one = luminance(a) + 0.05;
  const double two = luminance(b) + 0.05;
  return std::max(one, two) / std::min(one, two);
}

TEST(Swatch, IsSeenOnEitherGroundAndHasTheColourOfTheFigure) {
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    apply_theme(*qApp, theme);
    // The darkest and the brightest end of the colours of a range, and one in between.
    for (const QColor color : {QColor(68, 1, 84), QColor(253, 231, 37), QColor(0, 220, 90)}) {
      QLabel label;
      label.setTextFormat(Qt::RichText);
      label.setText(swatch_html(color, label.palette()));
      label.resize(label.sizeHint());
      const QImage picture = label.grab().toImage();
      const QColor ground = label.palette().color(QPalette::Window);
      double best = 0.0;
      int filled = 0;
      for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
          const QColor pixel = picture.pixelColor(x, y);
          best = std::max(best, contrast(pixel, ground));
          if (pixel.rgb() == color.rgb()) ++filled;
        }
      }
      EXPECT_GT(best, 3.0) << name_of(theme).toStdString() << " " << color.name().toStdString();
      EXPECT_GT(filled, 40) << name_of(theme).toStdString() << " " << color.name().toStdString();
    }
  }
  apply_theme(*qApp, Theme::kLight);
}

}  // namespace
}  // namespace lvcalib::widgets::swatch_test
