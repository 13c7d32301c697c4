// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/color_bar.h"

#include <QLocale>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "style/swatch.h"

namespace lvcalib::widgets {
namespace {

constexpr int kBarWidth = 14;
constexpr int kMargin = 6;
constexpr int kTick = 4;
constexpr int kHistogramWidth = 26;
constexpr int kSwatch = 12;
constexpr int kWidestName = 130;

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
  setScale(scale, quantity, scale, {});
}

void ColorBar::setScale(const ColorScale& scale, const QString& quantity, const ColorScale& whole,
                        const std::vector<int>& histogram) {
  whole_ = whole;
  histogram_ = histogram;
  categories_.clear();
  // While an end is dragged, what was built for an earlier place of it arrives.
  if (dragged_ == End::kNone) scale_ = scale;
  quantity_ = quantity;
  has_scale_ = true;
  setCursor(histogram.empty() ? Qt::ArrowCursor : Qt::SplitVCursor);
  setAccessibleName(quantity);
  setToolTip(histogram.empty()
                 ? QString()
                 : tr("Drag the ends of the colours; a double click takes them back"));
  updateGeometry();
  update();
}

void ColorBar::setNameOnly(const QString& quantity) {
  quantity_ = quantity;
  has_scale_ = false;
  histogram_.clear();
  categories_.clear();
  setToolTip({});
  setCursor(Qt::ArrowCursor);
  setAccessibleName(quantity);
  updateGeometry();
  update();
}

void ColorBar::setCategories(const std::vector<CloudCategory>& categories,
                             const QString& quantity) {
  setNameOnly(quantity);
  categories_ = categories;
  // Names in full, and all of them, whatever room there is.
  QString all;
  for (const CloudCategory& category : categories_) {
    all += QStringLiteral("%1&nbsp;%2<br>")
               .arg(swatch_html(QColor(category.color), palette()), category.name.toHtmlEscaped());
  }
  setToolTip(all);
  updateGeometry();
  update();
}

void ColorBar::paintCategories(QPainter& painter) const {
  const QFontMetrics metrics(font());
  const int line = metrics.height() + 4;
  const int left = 2 * kMargin + kSwatch;
  const int room = width() - left - kMargin;
  int y = kMargin;
  painter.drawText(QRect(kMargin, y, width() - kMargin, line), Qt::AlignLeft | Qt::AlignVCenter,
                   quantity_);
  for (std::size_t k = 0; k < categories_.size(); ++k) {
    y += line;
    // The last line says that there are more; the tool tip has all.
    if (y + 2 * line > height() && k + 1 < categories_.size()) {
      painter.drawText(QRect(left, y, room, line), Qt::AlignLeft | Qt::AlignVCenter,
                       QStringLiteral("… +%1").arg(categories_.size() - k));
      return;
    }
    paint_swatch(painter, QRectF(kMargin, y + (line - kSwatch) / 2.0, kSwatch, kSwatch),
                 QColor(categories_[k].color), palette());
    painter.drawText(QRect(left, y, room, line), Qt::AlignLeft | Qt::AlignVCenter,
                     metrics.elidedText(categories_[k].name, Qt::ElideMiddle, room));
  }
}

QSize ColorBar::sizeHint() const {
  const QFontMetrics metrics(font());
  if (!categories_.empty()) {
    int widest = metrics.horizontalAdvance(quantity_) - kSwatch - kMargin;
    for (const CloudCategory& category : categories_)
      widest = std::max(widest, metrics.horizontalAdvance(category.name));
    return {3 * kMargin + kSwatch + std::min(widest + 2, kWidestName), 160};
  }
  const int name = metrics.height() + kMargin;
  const int numbers = metrics.horizontalAdvance("-8888.8");
  return {2 * kMargin + name + (has_scale_ ? kBarWidth + kTick + numbers : 0) +
              (histogram_.empty() ? 0 : kHistogramWidth),
          160};
}

QSize ColorBar::minimumSizeHint() const {
  return {sizeHint().width(), 60};
}

QRect ColorBar::bar() const {
  const int half = QFontMetrics(font()).height() / 2;
  return {kMargin + (histogram_.empty() ? 0 : kHistogramWidth), kMargin + half, kBarWidth,
          std::max(1, height() - 2 * (kMargin + half))};
}

double ColorBar::valueAt(int y) const {
  const QRect b = bar();
  const double share = 1.0 - static_cast<double>(y - b.top()) / std::max(1, b.height() - 1);
  return whole_.low + std::clamp(share, 0.0, 1.0) * (whole_.high - whole_.low);
}

int ColorBar::yOf(double value) const {
  const QRect b = bar();
  const double range = whole_.high - whole_.low;
  const double share = range > 0.0 ? std::clamp((value - whole_.low) / range, 0.0, 1.0) : 0.0;
  return b.bottom() - static_cast<int>(share * (b.height() - 1));
}

void ColorBar::mousePressEvent(QMouseEvent* event) {
  if (histogram_.empty() || event->button() != Qt::LeftButton) return;
  const int y = event->position().toPoint().y();
  dragged_ =
      std::abs(y - yOf(scale_.low)) < std::abs(y - yOf(scale_.high)) ? End::kLow : End::kHigh;
}

void ColorBar::mouseMoveEvent(QMouseEvent* event) {
  if (dragged_ == End::kNone) return;
  // The ends never meet: a hundredth of the range stays between them.
  const double gap = 0.01 * (whole_.high - whole_.low);
  const double value = valueAt(event->position().toPoint().y());
  if (dragged_ == End::kLow) {
    scale_.low = std::min(value, scale_.high - gap);
  } else {
    scale_.high = std::max(value, scale_.low + gap);
  }
  update();
  Q_EMIT rangeChosen(scale_.low, scale_.high);
}

void ColorBar::mouseReleaseEvent(QMouseEvent* /*event*/) {
  dragged_ = End::kNone;
}

void ColorBar::mouseDoubleClickEvent(QMouseEvent* /*event*/) {
  dragged_ = End::kNone;
  if (!histogram_.empty()) Q_EMIT rangeCleared();
}

void ColorBar::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  const QFontMetrics metrics(font());
  painter.setPen(palette().color(QPalette::WindowText));
  if (!categories_.empty()) {
    paintCategories(painter);
    return;
  }
  const QString name = metrics.elidedText(quantity_, Qt::ElideRight, height() - 2 * kMargin);
  painter.save();
  painter.translate(width() - kMargin - metrics.descent(), height() - kMargin);
  painter.rotate(-90);
  painter.drawText(0, 0, name);
  painter.restore();
  if (!has_scale_) return;

  const QRect bar = this->bar();
  const double width = scale_.high - scale_.low;
  for (int y = bar.top(); y <= bar.bottom(); ++y) {
    const double share = width > 0.0 ? (valueAt(y) - scale_.low) / width
                                     : 1.0 - (y - bar.top() + 0.5) / bar.height();
    painter.fillRect(bar.left(), y, bar.width(), 1, QColor::fromRgb(map_color(scale_.map, share)));
  }
  if (!histogram_.empty()) {
    const int most = std::max(1, *std::max_element(histogram_.begin(), histogram_.end()));
    QColor color = palette().color(QPalette::WindowText);
    color.setAlpha(120);
    const auto bins = static_cast<double>(histogram_.size());
    for (std::size_t k = 0; k < histogram_.size(); ++k) {
      const double top = bar.bottom() + 1 - static_cast<double>(k + 1) / bins * bar.height();
      // The root, so that rare values are seen beside common ones.
      const double length = kHistogramWidth * std::sqrt(static_cast<double>(histogram_[k]) / most);
      painter.fillRect(QRectF(bar.left() - length, top, length, bar.height() / bins), color);
    }
    painter.setPen(QPen(palette().color(QPalette::Highlight), 2.0));
    for (const double end : {scale_.low, scale_.high})
      painter.drawLine(bar.left() - kHistogramWidth, yOf(end), bar.right() + kTick, yOf(end));
    painter.setPen(palette().color(QPalette::WindowText));
  }
  const double range = whole_.high - whole_.low;
  if (!(range > 0)) return;
  const double step = round_step(range);
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
  for (double v = std::ceil(whole_.low / step - 1e-9) * step; v <= whole_.high + 1e-9 * step;
       v += step) {
    const int y = yOf(v);
    painter.drawLine(bar.right() + 1, y, bar.right() + kTick, y);
    const double shown = std::abs(v) < 1e-6 * step ? 0.0 : v;
    painter.drawText(bar.right() + kTick + 3, y + metrics.ascent() / 2 - 1,
                     locale().toString(shown, 'f', decimals));
  }
}

}  // namespace lvcalib::widgets

#include "moc_color_bar.cpp"
