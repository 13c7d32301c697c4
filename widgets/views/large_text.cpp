// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/large_text.h"

#include <QFontMetricsF>
#include <QPainter>

namespace lvcalib::widgets {
namespace {

constexpr double kLeast_pt = 8.0;
constexpr double kStep_pt = 0.5;  // finer steps are not seen

QFont sized(QFont font, double points) {
  font.setPointSizeF(points);
  return font;
}

}  // namespace

LargeText::LargeText(double most_pt, QWidget* parent)
    : QWidget(parent), most_pt_(most_pt), points_(most_pt) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void LargeText::setText(const QString& text) {
  if (text == text_) return;
  text_ = text;
  setAccessibleName(text);
  fit();
}

void LargeText::setColor(const QColor& color) {
  color_ = color;
  update();
}

void LargeText::setAlignment(Qt::Alignment alignment) {
  alignment_ = alignment;
  update();
}

bool LargeText::fits(double points) const {
  const QFontMetricsF metrics(sized(font(), points));
  const QRectF room = rect();
  const QRectF taken = metrics.boundingRect(
      QRectF(0.0, 0.0, room.width(), 1e6),
      int(alignment_ & Qt::AlignHorizontal_Mask) | int(Qt::TextWordWrap), text_);
  return taken.width() <= room.width() && taken.height() <= room.height();
}

void LargeText::fit() {
  // Halves until a step remains: what fits in large letters fits in small ones.
  double low = kLeast_pt;
  double high = most_pt_;
  if (fits(high)) {
    low = high;
  } else {
    while (high - low > kStep_pt) {
      const double middle = 0.5 * (low + high);
      (fits(middle) ? low : high) = middle;
    }
  }
  points_ = low;
  update();
}

void LargeText::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  fit();
}

void LargeText::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setFont(sized(font(), points_));
  painter.setPen(color_.isValid() ? color_ : palette().color(QPalette::WindowText));
  painter.drawText(rect(), int(alignment_) | int(Qt::TextWordWrap), text_);
}

}  // namespace lvcalib::widgets

#include "moc_large_text.cpp"
