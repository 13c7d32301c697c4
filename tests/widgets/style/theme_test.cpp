// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/theme.h"

#include <QApplication>
#include <QImage>
#include <QPainter>
#include <QStyle>
#include <QStyleOptionButton>
#include <cmath>

#include <gtest/gtest.h>

namespace lvcalib::widgets::theme_test {
namespace {

// Relative luminance contrast as WCAG 2 defines it.
double contrast(const QColor& a, const QColor& b) {
  const auto linear = [](double c) {
    return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const auto luminance = [&](const QColor& c) {
    return 0.2126 * linear(c.redF()) + 0.7152 * linear(c.greenF()) + 0.0722 * linear(c.blueF());
  };
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

TEST(Theme, NamesReadBack) {
  for (const Theme theme : {Theme::kSystem, Theme::kLight, Theme::kDark}) {
    EXPECT_EQ(theme_named(name_of(theme)), theme);
  }
  EXPECT_EQ(theme_named(QStringLiteral("purple")), Theme::kSystem);
}

TEST(Theme, TextAndStatesAreReadableInLightAndDark) {
  for (const Theme theme : {Theme::kLight, Theme::kDark}) {
    apply_theme(*qApp, theme);
    const QPalette p = qApp->palette();
    EXPECT_EQ(is_dark(p), theme == Theme::kDark);
    const StateColors colors = state_colors(p);
    for (const auto ground : {QPalette::Base, QPalette::Window}) {
      EXPECT_GT(contrast(p.color(QPalette::Text), p.color(ground)), 7.0);
      for (const QColor& c : {colors.good, colors.doubtful, colors.bad, colors.idle}) {
        EXPECT_GT(contrast(c, p.color(ground)), 3.0) << c.name().toStdString();
      }
    }
    EXPECT_GT(contrast(p.color(QPalette::HighlightedText), p.color(QPalette::Highlight)), 3.0);
  }
}

// An empty check box must be seen: in the list of scenes it is what brings a scene back.
TEST(Theme, AnEmptyCheckBoxHasAVisibleEdge) {
  for (const Theme theme : {Theme::kLight, Theme::kDark}) {
    apply_theme(*qApp, theme);
    for (const auto element : {QStyle::PE_IndicatorCheckBox, QStyle::PE_IndicatorItemViewItemCheck,
                               QStyle::PE_IndicatorRadioButton}) {
      QImage image(20, 20, QImage::Format_RGB32);
      const QColor ground = qApp->palette().color(QPalette::Base);
      image.fill(ground);
      QStyleOptionButton option;
      option.palette = qApp->palette();
      option.rect = QRect(3, 3, 13, 13);
      option.state = QStyle::State_Enabled | QStyle::State_Off;
      QPainter painter(&image);
      qApp->style()->drawPrimitive(element, &option, &painter);
      painter.end();
      EXPECT_GT(contrast(image.pixelColor(9, 3), ground), 3.0)
          << name_of(theme).toStdString() << " " << element;
    }
  }
}

// What is switched on is seen at a glance, and what stands on it can be read.
TEST(Theme, ACheckedButtonIsToldFromAnUncheckedOne) {
  for (const Theme theme : {Theme::kLight, Theme::kDark}) {
    apply_theme(*qApp, theme);
    const QPalette colors = qApp->palette();
    const auto draw = [&](QStyle::PrimitiveElement element, QStyle::State state) {
      QImage image(60, 24, QImage::Format_RGB32);
      image.fill(colors.color(QPalette::Window));
      QStyleOptionButton option;
      option.palette = colors;
      option.rect = image.rect();
      option.state = QStyle::State_Enabled | QStyle::State_AutoRaise | state;
      QPainter painter(&image);
      qApp->style()->drawPrimitive(element, &option, &painter);
      painter.end();
      return image;
    };
    for (const auto element : {QStyle::PE_PanelButtonTool, QStyle::PE_PanelButtonCommand}) {
      const QImage on = draw(element, QStyle::State_On);
      const QImage off = draw(element, QStyle::State_Off | QStyle::State_Raised);
      const QColor fill = on.pixelColor(30, 12);
      const QColor plain = off.pixelColor(30, 12);
      const int apart = std::abs(fill.red() - plain.red()) +
                        std::abs(fill.green() - plain.green()) +
                        std::abs(fill.blue() - plain.blue());
      EXPECT_GT(apart, 60) << name_of(theme).toStdString() << " " << element;
      EXPECT_GT(contrast(on.pixelColor(30, 1), plain), 1.8)
          << name_of(theme).toStdString() << ", its edge";
      EXPECT_GT(contrast(colors.color(QPalette::ButtonText), fill), 4.5);
    }
  }
}

}  // namespace
}  // namespace lvcalib::widgets::theme_test
