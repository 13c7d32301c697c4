// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/uncertainty_plots.h"

#include <algorithm>
#include <cmath>

#include "style/texts.h"
#include "views/color_map.h"

namespace lvcalib::widgets {
namespace {

constexpr int kGradientStops = 32;

QCPColorGradient gradient() {
  QCPColorGradient out;
  out.clearColorStops();
  for (int k = 0; k <= kGradientStops; ++k) {
    const double share = static_cast<double>(k) / kGradientStops;
    out.setColorStopAt(share, QColor(map_color(ColorMap::kSequential, share)));
  }
  out.setNanHandling(QCPColorGradient::nhTransparent);
  return out;
}

QSharedPointer<QCPAxisTickerLog> decades() {
  QSharedPointer<QCPAxisTickerLog> ticker(new QCPAxisTickerLog);
  ticker->setSubTickCount(9);
  return ticker;
}

}  // namespace

UncertaintyMapPlot::UncertaintyMapPlot(Of of, QWidget* parent) : PlotView(parent), of_(of) {
  const char* name = of == Of::kExtrinsic ? "uncertainty-map" : "camera-uncertainty";
  setObjectName(name);
  figureActions()->setName(name);
  yAxis->setRangeReversed(true);
  scale_ = new QCPColorScale(this);
  scale_->setType(QCPAxis::atRight);
  scale_->setGradient(gradient());
  scale_->setRangeDrag(false);
  scale_->setRangeZoom(false);
  plotLayout()->addElement(0, 1, scale_);
  auto* margins = new QCPMarginGroup(this);
  axisRect()->setMarginGroup(QCP::msTop | QCP::msBottom, margins);
  scale_->setMarginGroup(QCP::msTop | QCP::msBottom, margins);
  follow_language(this, [this] {
    xAxis->setLabel(tr("image u (px)"));
    yAxis->setLabel(tr("image v (px)"));
    const bool extrinsic = of_ == Of::kExtrinsic;
    scale_->axis()->setLabel(extrinsic ? tr("standard deviation by noise (px)")
                                       : tr("standard deviation (px)"));
    setToolTip(
        !extrinsic
            ? tr("Where in the image a direction falls is known to one standard deviation of so "
                 "many pixels. Where the colour is bright, take images with the board there.")
            : tr("Where in the image a LiDAR point falls is known to one standard deviation of so "
                 "many "
                 "pixels, by the noise of these scenes alone. Where the colour is bright, take a "
                 "scene with the board there."));
  });
  connect(this, &QCustomPlot::afterLayout, this, [this] {
    if (axisRect()->size() == fitted_to_) return;
    fitted_to_ = axisRect()->size();
    fit();
    replot(rpQueuedReplot);
  });
}

void UncertaintyMapPlot::setMap(std::optional<ProjectedUncertainty> map, const QSize& image_px) {
  map_ = std::move(map);
  image_px_ = image_px;
  fit();
  rebuild();
}

// The image in the middle, with square pixels.
void UncertaintyMapPlot::fit() {
  if (image_px_.isEmpty()) return;
  const double w = image_px_.width();
  const double h = image_px_.height();
  const QRect rect = axisRect()->rect();
  const double aspect = rect.height() > 10 ? static_cast<double>(rect.width()) / rect.height() : 1;
  const double half_y = 0.5 * std::max(h, w / aspect);
  setHome({0.5 * w - half_y * aspect, 0.5 * w + half_y * aspect},
          {0.5 * h - half_y, 0.5 * h + half_y});
}

void UncertaintyMapPlot::drawCells(const ProjectedUncertainty& map) {
  auto* cells = new QCPColorMap(xAxis, yAxis);
  cells->data()->setSize(map.columns, map.rows);
  const Eigen::Vector2d first = map.pixel.front();
  const Eigen::Vector2d last = map.pixel.back();
  cells->data()->setRange({first.x(), last.x()}, {first.y(), last.y()});
  double low = HUGE_VAL;
  double high = 0.0;
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const double sigma = map.sigma_px[static_cast<std::size_t>(row * map.columns + column)];
      cells->data()->setCell(column, row, sigma);
      if (!std::isfinite(sigma)) continue;
      low = std::min(low, sigma);
      high = std::max(high, sigma);
    }
  }
  cells->setInterpolate(false);
  // Outer cells are centred on the image's edge: their other halves lie beside it.
  cells->setTightBoundary(true);
  cells->setColorScale(scale_);
  cells->setGradient(gradient());
  // Zero stands at the dark end, so that a colour means the same whatever the best spot is.
  scale_->setDataRange({0.0, std::max(high, 1e-6)});
}

void UncertaintyMapPlot::styleScale() {
  QCPAxis* axis = scale_->axis();
  axis->setTickLabelColor(colors().text);
  axis->setLabelColor(colors().text);
  axis->setLabelFont(xAxis->labelFont());
  axis->setTickLabelFont(xAxis->tickLabelFont());
  axis->setBasePen(QPen(colors().axis));
  axis->setTickPen(QPen(colors().axis));
  axis->setSubTickPen(QPen(colors().axis));
}

void UncertaintyMapPlot::rebuild() {
  clearFigure();
  styleScale();
  std::vector<QStringList> rows;
  const bool any = map_ && !map_->pixel.empty() &&
                   std::any_of(map_->sigma_px.begin(), map_->sigma_px.end(),
                               [](double sigma) { return std::isfinite(sigma); });
  scale_->setVisible(any);
  if (any) {
    drawCells(*map_);
    auto* frame = new QCPItemRect(this);
    frame->topLeft->setCoords(0, 0);
    frame->bottomRight->setCoords(image_px_.width(), image_px_.height());
    frame->setPen(QPen(colors().axis));
    for (std::size_t k = 0; k < map_->pixel.size(); ++k) {
      rows.push_back({csv_number(map_->pixel[k].x()), csv_number(map_->pixel[k].y()),
                      csv_number(map_->sigma_px[k])});
    }
  } else {
    showMessage(of_ == Of::kExtrinsic || image_px_.isEmpty()
                    ? tr("no result yet")
                    : tr("the intrinsics are taken as given, without standard deviations"));
  }
  setTable({"u_px", "v_px", "sigma_px"}, std::move(rows));
  replot(rpQueuedReplot);
}

UncertaintyRangePlot::UncertaintyRangePlot(QWidget* parent) : PlotView(parent) {
  setObjectName("uncertainty-range");
  figureActions()->setName("uncertainty-range");
  xAxis->setScaleType(QCPAxis::stLogarithmic);
  yAxis->setScaleType(QCPAxis::stLogarithmic);
  yAxis->setTicker(decades());
  yAxis->setNumberFormat("g");  // 10, not 10¹ beside a plain 1.
  follow_language(this, [this] {
    xAxis->setLabel(tr("range (m)"));
    yAxis->setLabel(tr("standard deviation (mm)"));
    setToolTip(tr(
        "How far a LiDAR point at this range may lie beside its true place in the camera frame: "
        "one standard deviation across the ray and along it. Through: in total, with what common "
        "errors that these scenes do not show could still do. Dashed: by noise alone."));
  });
}

void UncertaintyRangePlot::setRanges(std::vector<RangeUncertainty> noise,
                                     std::vector<RangeUncertainty> total) {
  noise_ = std::move(noise);
  total_ = std::move(total);
  if (total_.size() != noise_.size()) total_.clear();
  // Decades alone would leave a span of one or two without numbers.
  QSharedPointer<QCPAxisTickerText> ticks(new QCPAxisTickerText);
  for (const RangeUncertainty& r : noise_) ticks->addTick(r.range_m, QString::number(r.range_m));
  xAxis->setTicker(ticks);
  double low = HUGE_VAL;
  double high = 0.0;
  for (const auto* ranges : {&noise_, &total_}) {
    for (const RangeUncertainty& r : *ranges) {
      for (const double mm : {r.across_mm, r.along_mm}) {
        if (!(mm > 0.0)) continue;
        low = std::min(low, mm);
        high = std::max(high, mm);
      }
    }
  }
  if (low <= high && noise_.size() > 1)
    setHome({0.8 * noise_.front().range_m, 1.25 * noise_.back().range_m}, {0.6 * low, 2 * high});
  rebuild();
}

void UncertaintyRangePlot::drawCurve(const std::vector<RangeUncertainty>& ranges, bool across) {
  QCPGraph* graph = addGraph();
  const QColor color = colors().series(across ? 0 : 1);
  // What is stated is drawn through; noise is only its smaller part.
  const bool part = &ranges == &noise_ && !total_.empty();
  graph->setPen(QPen(color, part ? 1.5 : 2.0, part ? Qt::DashLine : Qt::SolidLine));
  graph->setScatterStyle({QCPScatterStyle::ssDisc, QPen(color), color, part ? 4.0 : 6.0});
  for (const RangeUncertainty& r : ranges)
    graph->addData(r.range_m, across ? r.across_mm : r.along_mm);
}

void UncertaintyRangePlot::rebuild() {
  clearFigure();
  std::vector<QStringList> rows;
  if (noise_.empty()) {
    showMessage(tr("no result yet"));
  } else {
    for (const bool across : {true, false}) {
      drawCurve(noise_, across);
      if (!total_.empty()) drawCurve(total_, across);
    }
    std::vector<LegendEntry> entries = {
        {LegendEntry::Sign::kLine, colors().series(0), tr("across the ray")},
        {LegendEntry::Sign::kLine, colors().series(1), tr("along the ray")}};
    if (!total_.empty())
      entries.push_back({LegendEntry::Sign::kDashed, colors().text, tr("by noise alone")});
    showLegend(std::move(entries));
  }
  for (std::size_t k = 0; k < noise_.size(); ++k) {
    const RangeUncertainty& r = noise_[k];
    rows.push_back({csv_number(r.range_m), csv_number(r.across_mm), csv_number(r.along_mm)});
    if (!total_.empty())
      rows.back() << csv_number(total_[k].across_mm) << csv_number(total_[k].along_mm);
  }
  QStringList titles = {"range_m", "across_mm", "along_mm"};
  if (!total_.empty())
    titles << "across_total_mm"
           << "along_total_mm";
  setTable(titles, std::move(rows));
  replot(rpQueuedReplot);
}

}  // namespace lvcalib::widgets

#include "moc_uncertainty_plots.cpp"
