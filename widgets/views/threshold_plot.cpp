// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/threshold_plot.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <algorithm>
#include <cmath>

#include "style/swatch.h"

namespace lvcalib::widgets {
namespace {

constexpr double kGrab_px = 7.0;
constexpr int kBins = 40;
constexpr double kKeyStep = 0.02;  // Of the range shown.

}  // namespace

ThresholdPlot::ThresholdPlot(QWidget* parent) : PlotView(parent) {
  setMouseTracking(true);
  setMinimumHeight(120);
  showWholeNumbers(*yAxis);
}

void ThresholdPlot::setValueLabel(const QString& label, const QString& csv_name) {
  xAxis->setLabel(label);
  csv_name_ = csv_name;
  figureActions()->setName(csv_name);
}

void ThresholdPlot::setValues(std::vector<double> values, const QString& message,
                              std::vector<bool> refused) {
  values_ = std::move(values);
  refused_ = std::move(refused);
  if (refused_.size() != values_.size()) refused_.clear();
  message_ = message;
  rebuild();
}

void ThresholdPlot::setThreshold(double threshold, double low, double high) {
  low_ = low;
  high_ = high;
  const double wanted = std::clamp(threshold, low, high);
  if (wanted != threshold_) refused_.clear();
  threshold_ = wanted;
  rebuild();
}

// What is shown: all values, and the line with room to move it.
double ThresholdPlot::reach() const {
  double top = 1.4 * threshold_;
  for (const double value : values_) top = std::max(top, 1.05 * value);
  return std::max(top, 1e-6);
}

void ThresholdPlot::rebuild() {
  clearFigure();
  yAxis->setLabel(tr("how many"));
  if (values_.empty()) {
    showMessage(message_);
    replot(rpQueuedReplot);
    return;
  }
  const double top = reach();
  const double width = top / kBins;
  std::vector<int> within(kBins, 0);
  std::vector<int> kept(kBins, 0);  // Beyond the line and in use: whoever decided saw them nearer.
  std::vector<int> beyond(kBins, 0);
  std::vector<QStringList> rows;
  for (std::size_t k = 0; k < values_.size(); ++k) {
    const double value = values_[k];
    const bool refused = refused_.empty() ? value > threshold_ : refused_[k];
    const int bin = std::clamp(static_cast<int>(value / width), 0, kBins - 1);
    ++(refused ? beyond : value > threshold_ ? kept : within)[static_cast<std::size_t>(bin)];
    rows.push_back({csv_number(value), refused ? "1" : "0"});
  }
  int most = 1;
  for (int k = 0; k < kBins; ++k) {
    const auto bin = static_cast<std::size_t>(k);
    int from = 0;
    const auto bar = [&](int count, const QBrush& brush, const QColor& edge) {
      if (count == 0) return;
      auto* rect = new QCPItemRect(this);
      rect->topLeft->setCoords(k * width, from + count);
      rect->bottomRight->setCoords((k + 1) * width, from);
      rect->setBrush(brush);
      rect->setPen(QPen(edge, 0.5));
      from += count;
    };
    bar(within[bin], colors().fill, colors().background);
    bar(kept[bin], hatched(colors().fill), colors().fill);
    bar(beyond[bin], colors().refused, colors().background);
    most = std::max(most, from);
  }
  auto* line = new QCPItemStraightLine(this);
  line->point1->setCoords(threshold_, 0.0);
  line->point2->setCoords(threshold_, 1.0);
  line->setPen(QPen(colors().refused, 2.0));
  auto* label = new QCPItemText(this);
  label->position->setCoords(threshold_, 1.12 * most);
  label->setPositionAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  label->setText(QStringLiteral(" %1 ▸").arg(threshold_, 0, 'f', 1));
  label->setColor(colors().refused);
  label->setFont(font());
  setTable({csv_name_, QStringLiteral("refused")}, std::move(rows));
  setHome({0.0, top}, {0.0, 1.25 * most});
  replot(rpQueuedReplot);
}

bool ThresholdPlot::isNearLine(const QPointF& place) const {
  return !values_.empty() && std::abs(place.x() - xAxis->coordToPixel(threshold_)) <= kGrab_px;
}

void ThresholdPlot::moveTo(double threshold) {
  // Tenths are as fine as anyone chooses.
  const double wanted = std::clamp(std::round(10.0 * threshold) / 10.0, low_, high_);
  if (wanted == threshold_) return;
  threshold_ = wanted;
  refused_.clear();
  rebuild();
  Q_EMIT thresholdMoved(threshold_);
}

void ThresholdPlot::keyPressEvent(QKeyEvent* event) {
  const double step = std::max(0.1, kKeyStep * reach());
  if (event->key() == Qt::Key_Left) {
    moveTo(threshold_ - step);
  } else if (event->key() == Qt::Key_Right) {
    moveTo(threshold_ + step);
  } else {
    PlotView::keyPressEvent(event);
  }
}

void ThresholdPlot::mousePressEvent(QMouseEvent* event) {
  dragging_ = event->button() == Qt::LeftButton && isNearLine(event->position());
  if (!dragging_) PlotView::mousePressEvent(event);
}

void ThresholdPlot::mouseMoveEvent(QMouseEvent* event) {
  if (dragging_) return moveTo(xAxis->pixelToCoord(event->position().x()));
  setCursor(isNearLine(event->position()) ? Qt::SplitHCursor : Qt::ArrowCursor);
  PlotView::mouseMoveEvent(event);
}

void ThresholdPlot::mouseReleaseEvent(QMouseEvent* event) {
  if (!dragging_) return PlotView::mouseReleaseEvent(event);
  dragging_ = false;
}

}  // namespace lvcalib::widgets

#include "moc_threshold_plot.cpp"
