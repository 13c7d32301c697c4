// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/residual_map_plot.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "modelling/model_text.h"
#include "modelling/residual_plot.h"
#include "style/texts.h"
#include "views/color_map.h"

namespace lvcalib::widgets {
namespace {

constexpr std::size_t kMostMarked = 3000;

QCPColorGradient diverging() {
  QCPColorGradient gradient;
  gradient.clearColorStops();
  for (int k = 0; k <= 16; ++k) {
    const double share = k / 16.0;
    gradient.setColorStopAt(share, QColor::fromRgb(map_color(ColorMap::kDiverging, share)));
  }
  gradient.setNanHandling(QCPColorGradient::nhTransparent);
  return gradient;
}

// Largest mean shown at full colour or length: outliers do not count.
double full_scale(const ResidualMap& map) {
  std::vector<float> sizes;
  for (const ResidualCell& cell : map.cells) {
    sizes.push_back(static_cast<float>(
        std::hypot(cell.first.mean, cell.second.n > 0 ? cell.second.mean : 0.0)));
  }
  return std::max(scale_for(sizes, ColorMap::kDiverging).high, 1e-9);
}

}  // namespace

ResidualMapPlot::ResidualMapPlot(Plane plane, QWidget* parent) : PlotView(parent), plane_(plane) {
  scale_ = new QCPColorScale(this);
  scale_->setGradient(diverging());
  scale_->setBarWidth(10);
  scale_->setRangeDrag(false);
  scale_->setRangeZoom(false);
  plotLayout()->addElement(0, 1, scale_);
  scale_->setMargins({0, 0, 0, 0});
  auto* margins = new QCPMarginGroup(this);
  axisRect()->setMarginGroup(QCP::msTop | QCP::msBottom, margins);
  scale_->setMarginGroup(QCP::msTop | QCP::msBottom, margins);
  if (plane == Plane::kImage) yAxis->setRangeReversed(true);
  const char* names[] = {"residuals-image", "residuals-board", "residuals-directions"};
  figureActions()->setName(QString::fromLatin1(names[static_cast<int>(plane)]));
  follow_language(this, [this] {
    setToolTip(
        tr("Mean residual of each cell. Outlined: different from zero beyond chance, all cells "
           "taken together. Corners are arrows, enlarged."));
    rebuild();
  });
  connect(selectionRect(), &QCPSelectionRect::changed, this, [this](const QRect& rect) {
    const QRect r = rect.normalized();
    const double x0 = xAxis->pixelToCoord(r.left());
    const double x1 = xAxis->pixelToCoord(r.right());
    const double y0 = yAxis->pixelToCoord(r.top());
    const double y1 = yAxis->pixelToCoord(r.bottom());
    Q_EMIT brushed(QRectF(QPointF(std::min(x0, x1), std::min(y0, y1)),
                          QPointF(std::max(x0, x1), std::max(y0, y1))));
  });
  connect(this, &QCustomPlot::afterLayout, this, [this] {
    if (axisRect()->size() == fitted_to_ || map() == nullptr) return;
    fit(*map());
    replot(rpQueuedReplot);
  });
  rebuild();
}

const char* ResidualMapPlot::xName() const {
  return plane_ == Plane::kImage ? "image x" : plane_ == Plane::kBoard ? "board x" : "azimuth";
}

const char* ResidualMapPlot::yName() const {
  return plane_ == Plane::kImage ? "image y" : plane_ == Plane::kBoard ? "board y" : "elevation";
}

void ResidualMapPlot::setView(std::shared_ptr<const ChannelView> view, const QString& message) {
  if (view == view_ && message == message_) return;
  view_ = std::move(view);
  message_ = message;
  selected_.clear();
  rebuild();
}

void ResidualMapPlot::setSelected(std::vector<std::size_t> rows) {
  selected_ = std::move(rows);
  rebuild();
}

const ResidualMap* ResidualMapPlot::map() const {
  if (!view_) return nullptr;
  const ResidualMap& map = plane_ == Plane::kImage   ? view_->image
                           : plane_ == Plane::kBoard ? view_->board
                                                     : view_->angles;
  return map.cells.empty() ? nullptr : &map;
}

void ResidualMapPlot::rebuild() {
  clearFigure();
  const ResidualMap* shown = map();
  const bool arrows = shown != nullptr && shown->cells.front().second.n > 0;
  scale_->setVisible(shown != nullptr && !arrows);
  for (QCPAxis* axis : {scale_->axis()}) {
    axis->setTickLabelColor(colors().text);
    axis->setLabelColor(colors().text);
    axis->setTickPen(QPen(colors().axis));
    axis->setSubTickPen(QPen(colors().axis));
    axis->setBasePen(QPen(colors().axis));
    axis->setTickLabelFont(font());
    axis->setLabelFont(font());
  }
  if (shown == nullptr) {
    xAxis->setLabel({});
    yAxis->setLabel({});
    showMessage(!view_ && !message_.isEmpty() ? message_
                : plane_ == Plane::kImage     ? tr("only corners lie in the image")
                : plane_ == Plane::kAngles    ? tr("corners have no direction")
                                              : tr("no data"));
    replot(rpQueuedReplot);
    return;
  }
  const auto& columns = view_->columns;
  const Covariate* x = columns.find(xName());
  const Covariate* y = columns.find(yName());
  xAxis->setLabel(axis_text(x->name, x->unit));
  yAxis->setLabel(axis_text(y->name, y->unit));
  scale_->setLabel(tr("mean residual (%1)").arg(unit_text(columns.channel)));
  fit(*shown);
  if (arrows) {
    drawArrows(*shown);
  } else {
    drawCells(*shown);
  }
  drawSelected();
  std::vector<QStringList> rows;
  for (const ResidualCell& cell : shown->cells) {
    rows.push_back({csv_number(cell.x), csv_number(cell.y), csv_number(cell.first.mean),
                    csv_number(cell.first.sigma), csv_number(cell.second.mean),
                    csv_number(cell.second.sigma), cell.significant() ? "1" : "0"});
  }
  setTable({"x", "y", "mean", "sigma", "mean_v", "sigma_v", "significant"}, std::move(rows));
  replot(rpQueuedReplot);
}

// Everything in sight; images and boards with equal scales.
void ResidualMapPlot::fit(const ResidualMap& map) {
  fitted_to_ = axisRect()->size();
  QCPRange x(map.x_low, map.x_high);
  QCPRange y(map.y_low, map.y_high);
  // Arrows reach beyond the cells at the edges.
  const double arrow = 0.7 * std::min(x.size() / map.columns, y.size() / map.rows);
  const double room = std::max(arrow, 0.04 * std::max(x.size(), y.size()));
  x = {x.lower - room, x.upper + room};
  y = {y.lower - room, y.upper + room};
  const QRect rect = axisRect()->rect();
  if (plane_ != Plane::kAngles && rect.width() > 10 && rect.height() > 10) {
    const double unit = std::max(x.size() / rect.width(), y.size() / rect.height());
    x = {x.center() - 0.5 * unit * rect.width(), x.center() + 0.5 * unit * rect.width()};
    y = {y.center() - 0.5 * unit * rect.height(), y.center() + 0.5 * unit * rect.height()};
  }
  setHome(x, y);
}

void ResidualMapPlot::drawCells(const ResidualMap& map) {
  const double full = full_scale(map);
  scale_->setDataRange({-full, full});
  const double w = (map.x_high - map.x_low) / map.columns;
  const double h = (map.y_high - map.y_low) / map.rows;
  auto* colors_of = new QCPColorMap(xAxis, yAxis);
  colors_of->data()->setSize(map.columns, map.rows);
  colors_of->data()->setRange({map.x_low + 0.5 * w, map.x_high - 0.5 * w},
                              {map.y_low + 0.5 * h, map.y_high - 0.5 * h});
  colors_of->data()->fill(std::nan(""));
  colors_of->setInterpolate(false);
  colors_of->setColorScale(scale_);
  for (const ResidualCell& cell : map.cells) {
    const int column = static_cast<int>((cell.x - map.x_low) / w);
    const int row = static_cast<int>((cell.y - map.y_low) / h);
    colors_of->data()->setCell(column, row, cell.first.mean);
    if (!cell.significant()) continue;
    auto* frame = new QCPItemRect(this);
    frame->topLeft->setCoords(cell.x - 0.46 * w, cell.y + 0.46 * h);
    frame->bottomRight->setCoords(cell.x + 0.46 * w, cell.y - 0.46 * h);
    frame->setPen(QPen(colors().mark, 1.4));
  }
}

void ResidualMapPlot::drawArrows(const ResidualMap& map) {
  const double full = full_scale(map);
  const double w = (map.x_high - map.x_low) / map.columns;
  const double h = (map.y_high - map.y_low) / map.rows;
  const double length = 0.9 * std::min(w, h) / full;
  // In the image y points down as the residual does; on the board it points up.
  for (const ResidualCell& cell : map.cells) {
    auto* arrow = new QCPItemLine(this);
    arrow->start->setCoords(cell.x, cell.y);
    arrow->end->setCoords(
        cell.x + length * cell.first.mean,
        cell.y + (plane_ == Plane::kImage ? 1.0 : -1.0) * length * cell.second.mean);
    arrow->setHead(QCPLineEnding(QCPLineEnding::esSpikeArrow, 6.0, 7.0));
    arrow->setPen(QPen(cell.significant() ? colors().refused : colors().axis,
                       cell.significant() ? 1.8 : 1.2));
  }
  auto* note = new QCPItemText(this);
  note->setText(tr("longest arrow: %1 px").arg(plain_number(full, 2)));
  note->setColor(colors().text);
  note->setFont(font());
  note->setPositionAlignment(Qt::AlignRight | Qt::AlignTop);
  note->setPadding({4, 2, 4, 2});
  note->setBrush(QBrush(colors().background));
  note->position->setType(QCPItemPosition::ptAxisRectRatio);
  note->position->setCoords(0.99, 0.01);
}

void ResidualMapPlot::drawSelected() {
  if (selected_.empty() || !view_) return;
  const Covariate* x = view_->columns.find(xName());
  const Covariate* y = view_->columns.find(yName());
  if (x == nullptr || y == nullptr) return;
  QCPGraph* graph = addGraph();
  graph->setLineStyle(QCPGraph::lsNone);
  graph->setScatterStyle(
      {QCPScatterStyle::ssDisc, QPen(colors().emphasis), QBrush(colors().emphasis), 3.0});
  const std::size_t stride = 1 + selected_.size() / kMostMarked;
  for (std::size_t k = 0; k < selected_.size(); k += stride) {
    graph->addData(static_cast<double>(x->values[selected_[k]]),
                   static_cast<double>(y->values[selected_[k]]));
  }
}

}  // namespace lvcalib::widgets

#include "moc_residual_map_plot.cpp"
