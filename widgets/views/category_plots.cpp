// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/category_plots.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <algorithm>
#include <cmath>
#include <limits>

namespace lvcalib::widgets {
namespace {

// How far above the highest value in use what is refused is still drawn where it lies.
constexpr double kRefusedReach = 1.5;

}  // namespace

CategoryPlot::CategoryPlot(QWidget* parent) : PlotView(parent) {
  setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
  axisRect()->setRangeZoom(Qt::Vertical);
  axisRect()->setRangeDrag(Qt::Vertical);
  xAxis->grid()->setVisible(false);
  connect(this, &PlotView::clicked, this, [this](const QPointF& place) {
    const int index = static_cast<int>(std::lround(xAxis->pixelToCoord(place.x()))) - 1;
    if (index >= 0 && index < columns_) Q_EMIT categoryClicked(index);
  });
}

void CategoryPlot::setValueLabel(const QString& label, const QString& csv_name) {
  yAxis->setLabel(label);
  csv_name_ = csv_name;
  figureActions()->setName(csv_name);
}

void CategoryPlot::setChosen(int index) {
  chosen_ = index;
  rebuild();
}

void CategoryPlot::layoutColumns(const QStringList& names, double low, double high) {
  columns_ = static_cast<int>(names.size());
  QSharedPointer<QCPAxisTickerText> ticker(new QCPAxisTickerText);
  for (int k = 0; k < columns_; ++k) ticker->addTick(k + 1, names[k]);
  xAxis->setTicker(ticker);
  xAxis->setSubTicks(false);
  // Many or long names do not fit side by side. Turned, they end below their tick: the other way
  // the last ones would leave the figure.
  const auto longest = std::max_element(
      names.begin(), names.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  const bool crowded =
      columns_ > 0 && static_cast<double>(columns_) * static_cast<double>(longest->size()) > 40.0;
  xAxis->setTickLabelRotation(crowded ? -60.0 : 0.0);
  const double span = std::max(high - low, 1e-12);
  setHome({0.4, std::max(columns_, 1) + 0.6},
          {low < 0 ? low - 0.05 * span : 0.0, high > 0 ? high + 0.08 * span : 1.0});
}

BarPlot::BarPlot(QWidget* parent) : CategoryPlot(parent) {
  setMouseTracking(true);
}

void BarPlot::setBars(std::vector<Bar> bars, const QString& message) {
  bars_ = std::move(bars);
  message_ = message;
  threshold_.reset();
  dragging_ = false;
  rebuild();
}

void BarPlot::setThresholdShown(bool shown) {
  threshold_shown_ = shown;
  rebuild();
}

void BarPlot::setThreshold(std::optional<double> threshold) {
  threshold_ = threshold;
  rebuild();
}

std::vector<int> BarPlot::beyond() const {
  std::vector<int> out;
  for (std::size_t k = 0; threshold_ && k < bars_.size(); ++k) {
    if (bars_[k].used && bars_[k].value > *threshold_) out.push_back(static_cast<int>(k));
  }
  return out;
}

double BarPlot::lineAt() const {
  return threshold_.value_or(1.05 * highest_);
}

void BarPlot::drawThreshold() {
  if (!threshold_shown_ || !(highest_ > 0.0)) return;
  auto* line = new QCPItemStraightLine(this);
  line->point1->setCoords(0.0, lineAt());
  line->point2->setCoords(1.0, lineAt());
  line->setPen(QPen(colors().refused, 2.0, threshold_ ? Qt::SolidLine : Qt::DashLine));
}

bool BarPlot::isNearLine(const QPointF& place) const {
  constexpr double kGrab_px = 6.0;
  return threshold_shown_ && highest_ > 0.0 &&
         std::abs(place.y() - yAxis->coordToPixel(lineAt())) <= kGrab_px;
}

void BarPlot::moveTo(double threshold) {
  // Above all bars it says nothing.
  threshold_ = threshold >= highest_ ? std::nullopt : std::optional(std::max(0.0, threshold));
  rebuild();
  Q_EMIT thresholdMoved();
}

void BarPlot::keyPressEvent(QKeyEvent* event) {
  constexpr double kKeyStep = 0.02;  // Of the highest bar.
  const bool up = event->key() == Qt::Key_Up;
  if (threshold_shown_ && (up || event->key() == Qt::Key_Down)) {
    moveTo(std::min(lineAt(), highest_) + (up ? kKeyStep : -kKeyStep) * highest_);
  } else {
    CategoryPlot::keyPressEvent(event);
  }
}

void BarPlot::mousePressEvent(QMouseEvent* event) {
  dragging_ = event->button() == Qt::LeftButton && isNearLine(event->position());
  if (!dragging_) CategoryPlot::mousePressEvent(event);
}

void BarPlot::mouseMoveEvent(QMouseEvent* event) {
  if (dragging_) return moveTo(yAxis->pixelToCoord(event->position().y()));
  setCursor(isNearLine(event->position()) ? Qt::SplitVCursor : Qt::ArrowCursor);
  CategoryPlot::mouseMoveEvent(event);
}

void BarPlot::mouseReleaseEvent(QMouseEvent* event) {
  if (!dragging_) return CategoryPlot::mouseReleaseEvent(event);
  dragging_ = false;
}

void BarPlot::rebuild() {
  clearFigure();
  QStringList names;
  double low = 0.0;
  double high = 0.0;
  std::vector<QStringList> rows;
  for (const Bar& bar : bars_) {
    names.push_back(bar.name);
    if (std::isfinite(bar.value)) {
      low = std::min(low, bar.value);
      high = std::max(high, bar.value);
    }
    rows.push_back({bar.name, csv_number(bar.value), bar.used ? "1" : "0"});
  }
  highest_ = high;
  layoutColumns(names, low, high);
  const std::vector<int> refused = beyond();
  for (std::size_t k = 0; k < bars_.size(); ++k) {
    auto* column = new QCPBars(xAxis, yAxis);
    QColor color = static_cast<int>(k) == chosen() ? colors().emphasis : colors().fill;
    if (std::binary_search(refused.begin(), refused.end(), static_cast<int>(k)))
      color = colors().refused;
    if (!bars_[k].used) color.setAlpha(70);
    column->setBrush(color);
    column->setPen(QPen(colors().axis));
    column->setWidth(0.62);
    if (std::isfinite(bars_[k].value)) column->addData(static_cast<double>(k + 1), bars_[k].value);
  }
  if (bars_.empty() || !message_.isEmpty())
    showMessage(message_.isEmpty() ? tr("no data") : message_);
  drawThreshold();
  setTable({"name", csvName(), "used"}, std::move(rows));
  replot(rpQueuedReplot);
}

void BoxPlot::setBoxes(std::vector<Box> boxes, const QString& message) {
  boxes_ = std::move(boxes);
  message_ = message;
  rebuild();
}

void BoxPlot::rebuild() {
  clearFigure();
  QStringList names;
  double low = 0.0;
  double high = 0.0;
  std::vector<QStringList> rows;
  auto* plot = new QCPStatisticalBox(xAxis, yAxis);
  plot->setWidth(0.5);
  plot->setBrush(colors().fill);
  plot->setPen(QPen(colors().axis));
  plot->setMedianPen(QPen(colors().fit, 2.2));
  plot->setWhiskerPen(QPen(colors().axis));
  plot->setWhiskerBarPen(QPen(colors().axis));
  // Red is for what is refused; an outlier is used.
  plot->setOutlierStyle({QCPScatterStyle::ssCircle, QPen(colors().axis), Qt::NoBrush, 4});
  QCPGraph* refused = addGraph();
  refused->setLineStyle(QCPGraph::lsNone);
  refused->setScatterStyle({QCPScatterStyle::ssCross, QPen(colors().refused, 1.6), Qt::NoBrush, 7});
  QCPGraph* beyond = addGraph();
  beyond->setLineStyle(QCPGraph::lsNone);
  beyond->setScatterStyle(
      {QCPScatterStyle::ssTriangle, QPen(colors().refused, 1.6), Qt::NoBrush, 7});
  for (std::size_t k = 0; k < boxes_.size(); ++k) {
    names.push_back(boxes_[k].name);
    for (const double v : boxes_[k].values) rows.push_back({boxes_[k].name, csv_number(v), "1"});
    for (const double v : boxes_[k].refused) rows.push_back({boxes_[k].name, csv_number(v), "0"});
    const BoxSummary box = box_summary(boxes_[k].values);
    if (box.count == 0) continue;
    const QVector<double> outliers(box.outliers.begin(), box.outliers.end());
    plot->addData(static_cast<double>(k + 1), box.lower_whisker, box.lower_quartile, box.median,
                  box.upper_quartile, box.upper_whisker, outliers);
    low = std::min({low, box.lower_whisker, outliers.isEmpty() ? 0.0 : outliers.front()});
    high = std::max({high, box.upper_whisker, outliers.isEmpty() ? 0.0 : outliers.back()});
  }
  // What was refused may be so far off that it would flatten the boxes: it is drawn at the edge
  // then.
  const double edge = high > 0.0 ? kRefusedReach * high : std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < boxes_.size(); ++k) {
    for (const double v : boxes_[k].refused) {
      (v > edge ? beyond : refused)->addData(static_cast<double>(k + 1), std::min(v, edge));
      high = std::max(high, std::min(v, edge));
    }
  }
  layoutColumns(names, low, high);
  if (rows.empty()) showMessage(message_.isEmpty() ? tr("no data") : message_);
  setTable({"name", csvName(), "used"}, std::move(rows));
  replot(rpQueuedReplot);
}

}  // namespace lvcalib::widgets

#include "moc_category_plots.cpp"
