// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/color_bar.h"

#include <QLocale>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace lvcalib::widgets {
namespace {

constexpr int kBarWidth = 14;
constexpr int kMargin = 6;
constexpr int kTick = 4;

// A step of 1, 2 or 5 times a power of ten that divides the range into four or more.
double round_step(double range) {
  const double wanted = range / 4.0;
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= wanted) return digit * power;
  }
  return power;
}

}  // namespace

ColorBar::ColorBar(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Expanding);
}

void ColorBar::setScale(const ColorScale& scale, const QString& quantity) {
  scale_ = scale;
  quantity_ = quantity;
  has_scale_ = true;
  setAccessibleName(quantity);
  updateGeometry();
  update();
}

void ColorBar::setNameOnly(const QString& quantity) {
  quantity_ = quantity;
  has_scale_ = false;
  setAccessibleName(quantity);
  updateGeometry();
  update();
}

QSize ColorBar::sizeHint() const {
  const QFontMetrics metrics(font());
  const int name = metrics.height() + kMargin;
  const int numbers = metrics.horizontalAdvance("-8888.8");
  return {2 * kMargin + name + (has_scale_ ? kBarWidth + kTick + numbers : 0), 160};
}

QSize ColorBar::minimumSizeHint() const {
  return {sizeHint().width(), 60};
}

void ColorBar::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  const QFontMetrics metrics(font());
  painter.setPen(palette().color(QPalette::WindowText));
  const QString name = metrics.elidedText(quantity_, Qt::ElideRight, height() - 2 * kMargin);
  painter.save();
  painter.translate(width() - kMargin - metrics.descent(), height() - kMargin);
  painter.rotate(-90);
  painter.drawText(0, 0, name);
  painter.restore();
  if (!has_scale_) return;

  const int half = metrics.height() / 2;
  const QRect bar(kMargin, kMargin + half, kBarWidth, std::max(1, height() - 2 * (kMargin + half)));
  for (int y = 0; y < bar.height(); ++y) {
    const double share = 1.0 - (y + 0.5) / bar.height();
    painter.fillRect(bar.left(), bar.top() + y, bar.width(), 1,
                     QColor::fromRgb(map_color(scale_.map, share)));
  }
  const double range = scale_.high - scale_.low;
  if (!(range > 0)) return;
  const double step = round_step(range);
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
  for (double v = std::ceil(scale_.low / step - 1e-9) * step; v <= scale_.high + 1e-9 * step;
       v += step) {
    const int y = bar.bottom() - static_cast<int>((v - scale_.low) / range * (bar.height() - 1));
    painter.drawLine(bar.right() + 1, y, bar.right() + kTick, y);
    const double shown = std::abs(v) < 1e-6 * step ? 0.0 : v;
    painter.drawText(bar.right() + kTick + 3, y + metrics.ascent() / 2 - 1,
                     locale().toString(shown, 'f', decimals));
  }
}

}  // namespace lvcalib::widgets
