// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/response_plots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/statistics.h"
#include "base/symmetric.h"
#include "base/units.h"
#include "response/response_curves.h"
#include "style/texts.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

// More dots than this only make a figure black, and slow.
constexpr std::size_t kMostDots = 3000;

bool in_use(const SceneResponse& scene, const BoundarySample& sample) {
  return scene.nodes[static_cast<std::size_t>(sample.node)].state == NodeResponseState::kUsed;
}

QString plus_minus(double value, double sigma, int decimals) {
  return QString("%1 ± %2")
      .arg(QString::number(value, 'f', decimals).replace('-', QChar(0x2212)))
      .arg(sigma, 0, 'f', decimals);
}

void add_caption(QCustomPlot& plot, const QString& text, const QColor& color) {
  auto* item = new QCPItemText(&plot);
  item->position->setType(QCPItemPosition::ptAxisRectRatio);
  item->position->setCoords(0.02, 0.02);
  item->setPositionAlignment(Qt::AlignLeft | Qt::AlignTop);
  item->setTextAlignment(Qt::AlignLeft);
  item->setColor(color);
  item->setFont(plot.font());
  item->setText(text);
  // Read on whatever is drawn beneath.
  item->setPadding({3, 1, 3, 1});
  QColor ground = PlotColors::of(plot.palette()).background;
  ground.setAlpha(215);
  item->setBrush(ground);
}

QCPGraph* add_dots(QCustomPlot& plot, const QColor& color, double size) {
  QCPGraph* graph = plot.addGraph();
  graph->setLineStyle(QCPGraph::lsNone);
  graph->setPen(Qt::NoPen);  // Else it would edge the dots; discs take their colour from it.
  graph->setScatterStyle({QCPScatterStyle::ssCircle, QPen(Qt::NoPen), color, size});
  return graph;
}

QColor faint(QColor color, int alpha) {
  color.setAlpha(alpha);
  return color;
}

}  // namespace

std::vector<const BoundarySample*> ResponseScope::samples(bool overlap_only,
                                                          std::size_t most) const {
  std::vector<const BoundarySample*> all;
  for (const SceneResponse* scene : scenes) {
    for (const BoundarySample& s : scene->samples) {
      if ((s.overlap || !overlap_only) && in_use(*scene, s)) all.push_back(&s);
    }
  }
  if (all.size() <= most) return all;
  std::vector<const BoundarySample*> some;
  for (std::size_t k = 0; k < most; ++k) some.push_back(all[k * all.size() / most]);
  return some;
}

TransitionPlot::TransitionPlot(QWidget* parent) : PlotView(parent) {
  figureActions()->setName("transition");
  follow_language(this, [this] {
    xAxis->setLabel(tr("distance from the circle (mm), outside positive"));
    yAxis->setLabel(scope_.scenes.size() > 1 ? tr("intensity, black 0 to white 1")
                                             : tr("intensity"));
    setToolTip(
        tr("Intensity of the returns about the circles against the signed distance to the nearest "
           "one. Small dots: samples (of many, some), blue those of the overlap "
           "region. Marks: means in classes of a millimetre with their standard deviation. Line: "
           "the fitted error function; δ is where it is half way, σ its width."));
  });
}

void TransitionPlot::setScope(const ResponseScope& scope) {
  scope_ = scope;
  yAxis->setLabel(scope_.scenes.size() > 1 ? tr("intensity, black 0 to white 1") : tr("intensity"));
  fit();
  rebuild();
}

// Scenes have levels of their own; together they are shown between them.
TransitionPlot::Levels TransitionPlot::levelsOf(const SceneResponse& scene) const {
  if (scope_.scenes.size() < 2 || !scene.transition) return {};
  return {scene.transition->mu_in, 1.0 / (scene.transition->mu_out - scene.transition->mu_in)};
}

void TransitionPlot::fit() {
  double low = 0.0;
  double high = 0.0;
  for (const BoundarySample* s : scope_.samples(false, kMostDots)) {
    low = std::min(low, kMmPerM * static_cast<double>(s->distance_m));
    high = std::max(high, kMmPerM * static_cast<double>(s->distance_m));
  }
  QCPRange y(-0.25, 1.25);
  if (scope_.scenes.size() == 1) {
    double top = 0.0;
    for (const TransitionBin& bin : transition_curve(*scope_.scenes.front()))
      top = std::max(top, bin.mean);
    y = QCPRange(-0.1 * top, 1.35 * top);
  }
  if (!(y.size() > 0.0)) y = QCPRange(0.0, 1.0);
  setHome(high > low ? QCPRange(low, high) : QCPRange(-30, 30), y);
}

void TransitionPlot::rebuild() {
  clearFigure();
  std::vector<QStringList> rows;
  drawSamples();
  for (std::size_t k = 0; k < scope_.scenes.size(); ++k) {
    const bool alone = scope_.scenes.size() == 1;
    if (!alone && !scope_.scenes[k]->transition) continue;  // It has no levels to scale by.
    drawMeans(*scope_.scenes[k], alone ? colors().mark : colors().series(scope_.colors[k]), rows);
  }
  if (scope_.transition != nullptr) drawFit();
  if (!rows.empty()) explain();
  if (rows.empty()) showMessage(scope_.reason.empty() ? tr("no data") : core_text(scope_.reason));
  drawCaption();
  setTable({"scene", "distance_mm", "mean_intensity", "sigma", "samples"}, std::move(rows));
  replot(rpQueuedReplot);
}

// Apart from the colours of the scenes.
QColor TransitionPlot::overlapColor() const {
  return colors().dark ? colors().emphasis : colors().fill;
}

void TransitionPlot::explain() {
  using Sign = LegendEntry::Sign;
  constexpr std::size_t kMostNames = 6;
  std::vector<LegendEntry> entries = {{Sign::kDot, colors().axis, tr("samples")},
                                      {Sign::kDot, overlapColor(), tr("overlap region")}};
  const std::size_t scenes = scope_.scenes.size();
  if (scenes == 1) entries.push_back({Sign::kDot, colors().mark, tr("means")});
  for (std::size_t k = 0; scenes > 1 && k < std::min(scenes, kMostNames); ++k) {
    if (!scope_.scenes[k]->transition) continue;
    const QString name = QString::fromStdString(scope_.scenes[k]->name);
    entries.push_back(
        {Sign::kDot, colors().series(scope_.colors[k]),
         k + 1 == kMostNames && scenes > kMostNames ? tr("… a colour for each scene") : name});
  }
  if (scope_.transition != nullptr) entries.push_back({Sign::kLine, colors().fit, tr("fit")});
  showLegend(std::move(entries));
}

void TransitionPlot::drawSamples() {
  QCPGraph* plain = add_dots(*this, faint(colors().axis, 110), 2.6);
  QCPGraph* overlap = add_dots(*this, faint(overlapColor(), 220), 2.6);
  for (const SceneResponse* scene : scope_.scenes) {
    if (scope_.scenes.size() > 1 && !scene->transition) continue;
    const Levels levels = levelsOf(*scene);
    ResponseScope one;
    one.scenes = {scene};
    for (const BoundarySample* s : one.samples(false, kMostDots / scope_.scenes.size())) {
      (s->overlap ? overlap : plain)
          ->addData(kMmPerM * static_cast<double>(s->distance_m),
                    levels.scale * (static_cast<double>(s->intensity) - levels.black));
    }
  }
}

void TransitionPlot::drawMeans(const SceneResponse& scene, const QColor& color,
                               std::vector<QStringList>& rows) {
  const Levels levels = levelsOf(scene);
  QCPGraph* means = add_dots(*this, color, 5.0);
  auto* bars = new QCPErrorBars(xAxis, yAxis);
  bars->removeFromLegend();
  bars->setDataPlottable(means);
  bars->setPen(QPen(color, 1.0));
  bars->setWhiskerWidth(3.0);
  for (const TransitionBin& bin : transition_curve(scene)) {
    means->addData(kMmPerM * bin.distance_m, levels.scale * (bin.mean - levels.black));
    bars->addData(std::isfinite(bin.mean_sigma) ? levels.scale * bin.mean_sigma : 0.0);
    rows.push_back({QString::fromStdString(scene.name), csv_number(kMmPerM * bin.distance_m),
                    csv_number(bin.mean), csv_number(bin.mean_sigma), QString::number(bin.n)});
  }
}

void TransitionPlot::drawFit() {
  const TransitionFit& fit = *scope_.transition;
  const bool scaled = scope_.scenes.size() > 1;
  QCPGraph* curve = addGraph();
  curve->setPen(QPen(colors().fit, 2.2));
  constexpr int kSteps = 300;
  for (int k = 0; k <= kSteps; ++k) {
    const double mm = xAxis->range().lower + xAxis->range().size() * k / kSteps;
    const double white = normal_cdf((1e-3 * mm - fit.delta_m) / fit.sigma_m);
    curve->addData(mm, scaled ? white : fit.mu_in + white * (fit.mu_out - fit.mu_in));
  }
  auto* middle = new QCPItemStraightLine(this);
  middle->point1->setCoords(kMmPerM * fit.delta_m, 0.0);
  middle->point2->setCoords(kMmPerM * fit.delta_m, 1.0);
  middle->setPen(QPen(colors().zero, 1, Qt::DashLine));
}

void TransitionPlot::drawCaption() {
  if (scope_.transition == nullptr) return;
  const TransitionFit& fit = *scope_.transition;
  add_caption(*this,
              tr("δ = %1 mm\nσ = %2 mm")
                  .arg(plus_minus(kMmPerM * fit.delta_m, kMmPerM * fit.delta_sigma_m, 3),
                       plus_minus(kMmPerM * fit.sigma_m, kMmPerM * fit.sigma_sigma_m, 3)),
              colors().text);
}

AnglePlot::AnglePlot(QWidget* parent) : PlotView(parent) {
  figureActions()->setName("pitch-yaw");
  follow_language(this, [this] {
    xAxis->setLabel(tr("yaw (°)"));
    yAxis->setLabel(tr("pitch (°)"));
    setToolTip(
        tr("Angles from each sample of the overlap region (of many, some) to the nearest point of "
           "the recovered circle. Solid: ellipses of one and two standard deviations of a beam on "
           "the edge. Dashed: one standard deviation of the dots themselves."));
  });
  connect(this, &QCustomPlot::afterLayout, this, [this] {
    // Degrees are as long up as across.
    const double aspect = axisRect()->height() > 10
                              ? static_cast<double>(axisRect()->width()) / axisRect()->height()
                              : 1.0;
    const double wanted = yAxis->range().size() * aspect;
    if (std::abs(wanted - xAxis->range().size()) < 1e-6 * wanted) return;
    setHome({-0.5 * wanted, 0.5 * wanted}, yAxis->range());
    replot(rpQueuedReplot);  // The ticks of this one are made already.
  });
}

void AnglePlot::setScope(const ResponseScope& scope) {
  scope_ = scope;
  fit();
  rebuild();
}

void AnglePlot::fit() {
  double reach = 0.0;
  for (const BoundarySample* s : scope_.samples(true, kMostDots))
    reach = std::max(reach,
                     kDegPerRad * static_cast<double>(s->residual.head<2>().cwiseAbs().maxCoeff()));
  if (scope_.statistics != nullptr)
    reach = std::max(reach, 2.0 * kDegPerRad * scope_.statistics->std_dev().head<2>().maxCoeff());
  reach = reach > 0.0 ? 1.08 * reach : 1.0;
  setHome({-reach, reach}, {-reach, reach});
}

std::vector<QStringList> AnglePlot::tableRows() const {
  std::vector<QStringList> rows;
  for (const BoundarySample* s : scope_.samples(true, kMostDots)) {
    const Eigen::Vector3d d = s->residual.cast<double>();
    rows.push_back({csv_number(kDegPerRad * d.x()), csv_number(kDegPerRad * d.y()),
                    csv_number(kMmPerM * d.z())});
  }
  return rows;
}

void AnglePlot::rebuild() {
  clearFigure();
  QCPGraph* dots = add_dots(*this, faint(colors().fill, 190), 3.2);
  for (const BoundarySample* s : scope_.samples(true, kMostDots)) {
    const Eigen::Vector3d d = s->residual.cast<double>();
    dots->addData(kDegPerRad * d.y(), kDegPerRad * d.x());
  }
  if (const ResponseStatistics* s = scope_.statistics) {
    drawEllipse(s->covariance.topLeftCorner<2, 2>(), 1.0, QPen(colors().fit, 2.2));
    drawEllipse(s->covariance.topLeftCorner<2, 2>(), 2.0, QPen(colors().fit, 1.4));
    drawEllipse(s->paired.topLeftCorner<2, 2>(), 1.0, QPen(colors().mark, 1.2, Qt::DashLine));
    using Sign = LegendEntry::Sign;
    showLegend({{Sign::kDot, colors().fill, tr("samples")},
                {Sign::kLine, colors().fit, tr("1σ, 2σ of a beam")},
                {Sign::kDashed, colors().mark, tr("1σ of the samples")}});
    const Eigen::Vector3d std_dev = kDegPerRad * s->std_dev();
    const Eigen::Vector3d sigma = kDegPerRad * s->std_sigma;
    add_caption(
        *this,
        tr("σ pitch %1°\nσ yaw %2°")
            .arg(plus_minus(std_dev.x(), sigma.x(), 4), plus_minus(std_dev.y(), sigma.y(), 4)),
        colors().text);
  } else {
    showMessage(scope_.reason.empty() ? tr("no data") : core_text(scope_.reason));
  }
  setTable({"pitch_deg", "yaw_deg", "range_mm"}, [this] { return tableRows(); });
  replot(rpQueuedReplot);
}

void AnglePlot::drawEllipse(const Eigen::Matrix2d& covariance_rad2, double sigmas,
                            const QPen& pen) {
  const auto axes = axes_of(covariance_rad2);
  const Eigen::Vector2d radii = sigmas * axes.values.cwiseMax(0.0).cwiseSqrt();
  const Eigen::Vector2d center = scope_.statistics->mean.head<2>();
  auto* curve = new QCPCurve(xAxis, yAxis);
  curve->setPen(pen);
  for (int k = 0; k <= 72; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 72;
    const Eigen::Vector2d p = center + axes.vectors * Eigen::Vector2d(radii.x() * std::cos(angle),
                                                                      radii.y() * std::sin(angle));
    curve->addData(kDegPerRad * p.y(), kDegPerRad * p.x());
  }
}

RangePlot::RangePlot(QWidget* parent) : PlotView(parent) {
  figureActions()->setName("range-histogram");
  axisRect()->setRangeZoom(Qt::Horizontal);
  axisRect()->setRangeDrag(Qt::Horizontal);
  showWholeNumbers(*yAxis);
  follow_language(this, [this] {
    xAxis->setLabel(tr("range off the board's plane (mm)"));
    yAxis->setLabel(tr("samples"));
    setToolTip(
        tr("Ranges of the samples of the overlap region, less the range of the board's plane along "
           "the same ray, in classes of 2 mm. Lines: one standard deviation of the range of a beam "
           "on the edge."));
  });
}

void RangePlot::setScope(const ResponseScope& scope) {
  scope_ = scope;
  rebuild();
}

void RangePlot::rebuild() {
  clearFigure();
  std::vector<QStringList> rows;
  auto* bars = new QCPBars(xAxis, yAxis);
  bars->setBrush(colors().fill);
  bars->setPen(QPen(colors().axis, 0.6));
  bars->setWidth(2.0);
  double reach = 0.0;
  double most = 0.0;
  for (const RangeBin& bin : range_histogram(scope_.scenes)) {
    const double low = kMmPerM * bin.low_m;
    bars->addData(low + 1.0, bin.n);
    reach = std::max({reach, std::abs(low), std::abs(low + 2.0)});
    most = std::max(most, static_cast<double>(bin.n));
    rows.push_back({csv_number(low), csv_number(low + 2.0), QString::number(bin.n)});
  }
  // A stray return far off must not squeeze the rest together; it can be panned to.
  if (scope_.statistics != nullptr)
    reach = std::min(reach, 6.0 * kMmPerM * scope_.statistics->std_dev().z());
  setHome(reach > 0 ? QCPRange(-reach, reach) : QCPRange(-50, 50),
          {0.0, most > 0 ? 1.25 * most : 1.0});
  if (scope_.statistics != nullptr) {
    drawSigma();
  } else {
    showMessage(scope_.reason.empty() ? tr("no data") : core_text(scope_.reason));
  }
  setTable({"low_mm", "high_mm", "samples"}, std::move(rows));
  replot(rpQueuedReplot);
}

void RangePlot::drawSigma() {
  const double sigma = kMmPerM * scope_.statistics->std_dev().z();
  for (const double x : {-sigma, 0.0, sigma}) {
    auto* line = new QCPItemStraightLine(this);
    line->point1->setCoords(x, 0.0);
    line->point2->setCoords(x, 1.0);
    line->setPen(x == 0.0 ? QPen(colors().zero, 1, Qt::DashLine) : QPen(colors().fit, 2.0));
  }
  using Sign = LegendEntry::Sign;
  showLegend({{Sign::kBox, colors().fill, tr("samples")},
              {Sign::kLine, colors().fit, tr("±1σ of a beam")}});
  add_caption(
      *this,
      tr("σ range %1 mm").arg(plus_minus(sigma, kMmPerM * scope_.statistics->std_sigma.z(), 2)),
      colors().text);
}

}  // namespace lvcalib::widgets

#include "moc_response_plots.cpp"
