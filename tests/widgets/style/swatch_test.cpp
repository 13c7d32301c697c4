// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/swatch.h"

#include <QApplication>
#include <QImage>
#include <QLabel>
#include <QPainter>
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

// Lines of two pixels, eight apart along either axis, however fine the screen is.
TEST(Swatch, HatchingCoversAThird) {
  for (const int finer : {1, 2, 3}) {
    QImage image(finer * 80, finer * 80, QImage::Format_ARGB32_Premultiplied);
    image.fill(Qt::white);
    QPainter painter(&image);
    painter.scale(finer, finer);
    painter.fillRect(QRect(0, 0, 80, 80), hatched(Qt::black));
    painter.end();
    double dark = 0.0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) dark += 1.0 - qGray(image.pixel(x, y)) / 255.0;
    }
    EXPECT_NEAR(dark / (image.width() * image.height()), 2.0 * std::sqrt(2.0) / 8.0, 0.02) << finer;
    // Plain along the lines, not along the rows.
    const auto at = [&](int x, int y) { return qGray(image.pixel(finer * x, finer * y)); };
    EXPECT_NEAR(at(40, 40), at(36, 44), 3);
    EXPECT_GT(std::abs(at(40, 40) - at(44, 40)), 150);
  }
}

}  // namespace
}  // namespace lvcalib::widgets::swatch_test
