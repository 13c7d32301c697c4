// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/theme.h"

#include <QApplication>
#include <QPainter>
#include <QProxyStyle>
#include <QStyleFactory>
#include <QStyleOption>

#include "words/quality_text.h"

namespace lvcalib::widgets {
namespace {

QPalette palette_of(const QColor& window, const QColor& button, const QColor& base,
                    const QColor& text, const QColor& accent, const QColor& disabled) {
  QPalette p(button, window);  // Edges follow the button colour.
  p.setColor(QPalette::Window, window);
  p.setColor(QPalette::Base, base);
  p.setColor(QPalette::AlternateBase, window);
  p.setColor(QPalette::ToolTipBase, base);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText,
                          QPalette::ToolTipText, QPalette::BrightText}) {
    p.setColor(role, text);
  }
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
    p.setColor(QPalette::Disabled, role, disabled);
  }
  p.setColor(QPalette::Disabled, QPalette::Button, window);
  p.setColor(QPalette::PlaceholderText, disabled);
  p.setColor(QPalette::Highlight, accent);
  p.setColor(QPalette::HighlightedText, Qt::white);
  p.setColor(QPalette::Disabled, QPalette::Highlight, disabled);
  p.setColor(QPalette::Link, accent);
  return p;
}

QPalette light_palette() {
  return palette_of(QColor(0xf4, 0xf5, 0xf6), QColor(0xec, 0xee, 0xf0), Qt::white,
                    QColor(0x1c, 0x1f, 0x23), QColor(0x1f, 0x6f, 0xb5), QColor(0x7d, 0x84, 0x8c));
}

QPalette dark_palette() {
  return palette_of(QColor(0x33, 0x36, 0x3b), QColor(0x50, 0x55, 0x5c), QColor(0x1e, 0x20, 0x23),
                    QColor(0xe6, 0xe8, 0xea), QColor(0x3d, 0x8f, 0xd6), QColor(0x8f, 0x95, 0x9c));
}

QColor mixed(const QColor& a, const QColor& b, double share) {
  return QColor::fromRgbF(static_cast<float>(a.redF() + share * (b.redF() - a.redF())),
                          static_cast<float>(a.greenF() + share * (b.greenF() - a.greenF())),
                          static_cast<float>(a.blueF() + share * (b.blueF() - a.blueF())));
}

// Fusion edges check boxes with a darkened window colour, which is faint on a light ground and
// vanishes on a dark one; a button that is down it only darkens a little, which cannot be told from
// one that is up on a dark ground.
class ThemeStyle : public QProxyStyle {
 public:
  ThemeStyle() : QProxyStyle(QStyleFactory::create(QStringLiteral("Fusion"))) {}

  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget) const override {
    const bool button = element == PE_PanelButtonTool || element == PE_PanelButtonCommand;
    if (button && option->state.testFlag(State_On)) {
      drawChecked(*option, *painter);
      return;
    }
    QProxyStyle::drawPrimitive(element, option, painter, widget);
    const bool box = element == PE_IndicatorCheckBox || element == PE_IndicatorItemViewItemCheck;
    if (!box && element != PE_IndicatorRadioButton) return;
    const QPalette& colors = option->palette;
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(mixed(colors.color(QPalette::Base), colors.color(QPalette::Text), 0.7));
    painter->setBrush(Qt::NoBrush);
    const QRectF edge = QRectF(option->rect).adjusted(0.5, 0.5, -0.5, -0.5);
    if (box) {
      painter->drawRoundedRect(edge, 2, 2);
    } else {
      painter->drawEllipse(edge);
    }
    painter->restore();
  }

 private:
  // In the colour of what is chosen, so far as the words on it stay readable.
  static void drawChecked(const QStyleOption& option, QPainter& painter) {
    const QPalette& colors = option.palette;
    const QColor accent = colors.color(QPalette::Highlight);
    const bool pressed = option.state.testFlag(State_Sunken);
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(is_dark(colors) ? accent.lighter(135) : accent, 2.0));
    painter.setBrush(mixed(colors.color(QPalette::Base), accent, pressed ? 0.5 : 0.35));
    painter.drawRoundedRect(QRectF(option.rect).adjusted(1.0, 1.0, -1.0, -1.0), 3, 3);
    painter.restore();
  }
};

}  // namespace

QString name_of(Theme theme) {
  switch (theme) {
    case Theme::kLight:
      return QStringLiteral("light");
    case Theme::kDark:
      return QStringLiteral("dark");
    case Theme::kSystem:
      break;
  }
  return QStringLiteral("system");
}

Theme theme_named(const QString& name) {
  if (name == QLatin1String("light")) return Theme::kLight;
  if (name == QLatin1String("dark")) return Theme::kDark;
  return Theme::kSystem;
}

void apply_theme(QApplication& application, Theme theme) {
  static const QPalette system = application.palette();  // As the desktop had it at the start.
  // Once: another style has every widget made up again, which takes a second in a full window.
  if (dynamic_cast<ThemeStyle*>(QApplication::style()) == nullptr)
    application.setStyle(new ThemeStyle);
  const bool dark = theme == Theme::kDark || (theme == Theme::kSystem && is_dark(system));
  application.setPalette(dark ? dark_palette() : light_palette());
}

bool is_dark(const QPalette& palette) {
  return palette.color(QPalette::Window).lightness() <
         palette.color(QPalette::WindowText).lightness();
}

StateColors state_colors(const QPalette& palette) {
  if (is_dark(palette)) {
    return {QColor(0x6c, 0xc6, 0x7a), QColor(0xe8, 0xb3, 0x4b), QColor(0xf0, 0x74, 0x6a),
            QColor(0x8f, 0x96, 0x9d), QColor(0x5a, 0xaa, 0xf0)};
  }
  return {QColor(0x2b, 0x86, 0x3d), QColor(0xa8, 0x6a, 0x00), QColor(0xbf, 0x2f, 0x2a),
          QColor(0x70, 0x77, 0x7f), QColor(0x1f, 0x6f, 0xb5)};
}

QColor color_of(const ToldQuality& told, const QPalette& palette) {
  const StateColors colors = state_colors(palette);
  if (told.open) return palette.color(QPalette::Text);
  if (told.quality == Quality::kGood) return colors.good;
  return told.quality == Quality::kFailed ? colors.bad : colors.doubtful;
}

}  // namespace lvcalib::widgets
