// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/plot_legend.h"

#include <algorithm>

namespace lvcalib::widgets {
namespace {

constexpr int kSignWidth = 18;
constexpr int kSignGap = 4;
constexpr int kEntryGap = 12;
constexpr int kMargin = 4;
// Lines that stand for any number of them.
constexpr std::size_t kMostLines = 3;
// A figure keeps this much of its height for what it shows.
constexpr int kLowestFigure = 130;

// One above the other, in as many colours as there is room for.
void draw_lines(QCPPainter& painter, const LegendEntry& entry, const QRectF& place) {
  const std::size_t count = std::min(kMostLines, entry.others.size() + 1);
  const double step = place.height() / static_cast<double>(kMostLines + 1);
  for (std::size_t k = 0; k < count; ++k) {
    painter.setPen(QPen(k == 0 ? entry.color : entry.others[k - 1], 1.6));
    const double y =
        place.center().y() + step * (static_cast<double>(k) - 0.5 * static_cast<double>(count - 1));
    painter.drawLine(QPointF(place.left(), y), QPointF(place.right(), y));
  }
}

void draw_sign(QCPPainter& painter, const LegendEntry& entry, const QRectF& place) {
  using Sign = LegendEntry::Sign;
  if (!entry.others.empty()) return draw_lines(painter, entry, place);
  const QPointF middle = place.center();
  const double y = middle.y();
  painter.setPen(
      QPen(entry.color, 2.0, entry.sign == Sign::kDashed ? Qt::DashLine : Qt::SolidLine));
  painter.setBrush(Qt::NoBrush);
  switch (entry.sign) {
    case Sign::kLine:
    case Sign::kDashed:
      painter.drawLine(QPointF(place.left(), y), QPointF(place.right(), y));
      break;
    case Sign::kDot:
      painter.setPen(Qt::NoPen);
      painter.setBrush(entry.color);
      painter.drawEllipse(middle, 3.2, 3.2);
      break;
    case Sign::kMark:
      painter.setPen(QPen(entry.color, 1.5));
      painter.drawEllipse(middle, 3.2, 3.2);
      break;
    case Sign::kBox:
      painter.setPen(Qt::NoPen);
      painter.fillRect(QRectF(middle.x() - 5.0, y - 5.0, 10.0, 10.0), entry.color);
      break;
    case Sign::kArrow:
      painter.drawLine(QPointF(place.left(), y), QPointF(place.right(), y));
      painter.drawLine(QPointF(place.right(), y), QPointF(place.right() - 5.0, y - 3.5));
      painter.drawLine(QPointF(place.right(), y), QPointF(place.right() - 5.0, y + 3.5));
      break;
  }
}

}  // namespace

PlotLegend::PlotLegend(QCustomPlot* plot) : QCPLayoutElement(plot) {
  setMinimumMargins({0, 0, 0, 0});
  setMargins({0, 0, 0, 0});
  setAutoMargins(QCP::msNone);
  plot->plotLayout()->insertRow(0);
  plot->plotLayout()->addElement(0, 0, this);
  plot->plotLayout()->setRowStretchFactor(0, 0.001);
  setLayer(QStringLiteral("legend"));
}

void PlotLegend::setEntries(std::vector<LegendEntry> entries, const QFont& font,
                            const QColor& text) {
  entries_ = std::move(entries);
  font_ = font;
  text_ = text;
}

int PlotLegend::lineHeight() const {
  return QFontMetrics(font_).height() + 2;
}

std::pair<std::vector<QPoint>, int> PlotLegend::arranged(int width) const {
  std::vector<QPoint> places;
  const QFontMetrics metrics(font_);
  int x = kMargin;
  int y = kMargin;
  for (const LegendEntry& entry : entries_) {
    const int wide = kSignWidth + kSignGap + metrics.horizontalAdvance(entry.text);
    if (x > kMargin && x + wide > width - kMargin) {
      x = kMargin;
      y += lineHeight();
    }
    places.emplace_back(x, y);
    x += wide + kEntryGap;
  }
  return {std::move(places), entries_.empty() ? 0 : y + lineHeight()};
}

bool PlotLegend::isShown() const {
  if (entries_.empty() || mParentPlot == nullptr) return false;
  return arranged(mParentPlot->viewport().width()).second + kLowestFigure <=
         mParentPlot->viewport().height();
}

QSize PlotLegend::minimumOuterSizeHint() const {
  return {0, isShown() ? arranged(mParentPlot->viewport().width()).second : 0};
}

QSize PlotLegend::maximumOuterSizeHint() const {
  return {QWIDGETSIZE_MAX, minimumOuterSizeHint().height()};
}

void PlotLegend::draw(QCPPainter* painter) {
  if (!isShown()) return;
  // Laid out over the whole figure: beside a colour scale the row is narrower than that.
  const QPoint corner = mParentPlot->viewport().topLeft();
  const auto [places, height] = arranged(mParentPlot->viewport().width());
  painter->setClipRect(QRect(corner, QSize(mParentPlot->viewport().width(), height + kMargin)));
  painter->setFont(font_);
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const QPoint at = corner + places[k];
    draw_sign(*painter, entries_[k], QRectF(at, QSizeF(kSignWidth, lineHeight())));
    painter->setPen(text_);
    painter->drawText(QRect(at + QPoint(kSignWidth + kSignGap, 0), QSize(4000, lineHeight())),
                      Qt::AlignLeft | Qt::AlignVCenter, entries_[k].text);
  }
}

void PlotLegend::applyDefaultAntialiasingHint(QCPPainter* painter) const {
  painter->setAntialiasing(true);
}

}  // namespace lvcalib::widgets
