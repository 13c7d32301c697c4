// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/angle_distance_plot.h"

#include <QMouseEvent>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/units.h"
#include "style/swatch.h"
#include "style/texts.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

constexpr int kIntensityLevels = 16;

// Fixed places every 90° read better than the automatic ones.
QSharedPointer<QCPAxisTickerFixed> quarter_ticks() {
  QSharedPointer<QCPAxisTickerFixed> ticker(new QCPAxisTickerFixed);
  ticker->setTickStep(90.0);
  ticker->setScaleStrategy(QCPAxisTickerFixed::ssMultiples);
  return ticker;
}

}  // namespace

AngleDistancePlot::AngleDistancePlot(QWidget* parent) : PlotView(parent) {
  xAxis->setTicker(quarter_ticks());
  addLayer("bands", layer("grid"), limBelow);
  figureActions()->setName("angle-distance");
  setCompact(false);
  connect(selectionRect(), &QCPSelectionRect::accepted, this,
          [this](const QRect& rect, const QMouseEvent* event) {
            emitBrush(rect.normalized(), event->modifiers().testFlag(Qt::ShiftModifier));
          });
  follow_language(this, [this] { retranslate(); });
}

void AngleDistancePlot::emitBrush(const QRect& rect, bool add) {
  const auto count = static_cast<int>(data_.record.bins.size());
  std::set<int> bins;
  const auto take = [&](double angle_rad, double distance_m) {
    const double angle_deg = kDegPerRad * angle_rad;
    const QPointF place(xAxis->coordToPixel(angle_deg), yAxis->coordToPixel(kMmPerM * distance_m));
    if (!QRectF(rect).contains(place)) return;
    bins.insert(std::clamp(static_cast<int>((angle_deg + 180.0) / 360.0 * count), 0, count - 1));
  };
  if (count > 0) {
    for (const NodeSample& s : data_.samples) take(s.angle_rad, s.distance_m);
    for (const BinRecord& bin : data_.record.bins) take(bin.angle_rad, bin.midpoint_m);
  }
  Q_EMIT binsBrushed({bins.begin(), bins.end()}, add);
}

void AngleDistancePlot::retranslate() {
  xAxis->setLabel(compact_ ? QString() : tr("polar angle ψ (°)"));
  yAxis->setLabel(compact_ ? QString() : tr("distance from the circle (mm)"));
  setToolTip(
      tr("Signed distance from the circle (mm, outside positive) against the polar angle "
         "(degrees). Dots: LiDAR samples coloured by intensity. Marks: where the intensity "
         "crosses its middle level in each angular bin, ±1σ. Line: the fitted wave "
         "Δcu·cos ψ + Δcv·sin ψ + Δr. Shaded: refused bins; violet and hatched: bins left out by "
         "hand."));
}

void AngleDistancePlot::setCompact(bool compact) {
  compact_ = compact;
  retranslate();
  axisRect()->setupFullAxesBox(!compact);
  if (compact) {
    axisRect()->setAutoMargins(QCP::msNone);
    axisRect()->setMargins(QMargins(30, 6, 8, 18));
    yAxis->ticker()->setTickCount(3);
  }
  xAxis2->setTickLabels(false);
  yAxis2->setTickLabels(false);
  // The wheel belongs to the page that holds many small plots.
  setInteractions(compact ? QCP::Interactions() : QCP::iRangeDrag | QCP::iRangeZoom);
}

void AngleDistancePlot::setTitle(const QString& title) {
  title_ = title;
  setAccessibleName(title);
  rebuild();
}

void AngleDistancePlot::setRefused(bool refused, bool by_hand) {
  if (refused == refused_ && by_hand == by_hand_) return;
  refused_ = refused;
  by_hand_ = by_hand;
  rebuild();
}

bool AngleDistancePlot::isByHand(std::size_t bin) const {
  return bin < data_.by_hand.size() && data_.by_hand[bin];
}

QColor AngleDistancePlot::refusalColor() const {
  return by_hand_ ? colors().left_out : colors().refused;
}

void AngleDistancePlot::setData(AngleDistanceData data) {
  const double before = data_.reach_m;
  data_ = std::move(data);
  message_.clear();
  const double reach = kMmPerM * data_.reach_m;
  // A replay keeps the user's zoom as long as the reach stays.
  if (before != data_.reach_m || xAxis->range().size() < 6.0) {
    setHome({-180.0, 180.0}, {-reach, reach});
  }
  rebuild();
}

void AngleDistancePlot::clear(const QString& message) {
  data_ = {};
  message_ = message;
  setHome({-180.0, 180.0}, {-20.0, 20.0});
  rebuild();
}

void AngleDistancePlot::setChosenBins(std::vector<int> bins) {
  if (bins == chosen_bins_) return;
  chosen_bins_ = std::move(bins);
  rebuild();
}

void AngleDistancePlot::rebuild() {
  clearFigure();
  if (!message_.isEmpty()) showMessage(message_);
  drawBands();
  drawSamples();
  drawWave();
  drawBins();
  drawRefusal();
  drawLabel();
  if (!compact_ && !data_.samples.empty()) explain();
  setTable({"kind", "angle_deg", "distance_mm", "sigma_mm", "samples", "state", "intensity"},
           [this] { return tableRows(); });
  replot(rpQueuedReplot);
}

void AngleDistancePlot::drawBands() {
  const auto count = data_.record.bins.size();
  const double width = count > 0 ? 360.0 / static_cast<double>(count) : 360.0;
  for (std::size_t k = 0; k < count; ++k) {
    const bool refused = data_.record.bins[k].state != BinState::kUsed;
    const bool chosen = std::find(chosen_bins_.begin(), chosen_bins_.end(), static_cast<int>(k)) !=
                        chosen_bins_.end();
    if (!refused && !chosen) continue;
    QColor color = chosen ? colors().emphasis : isByHand(k) ? colors().left_out : colors().refused;
    color.setAlpha(chosen ? 70 : 38);
    drawBand(k, width, color);
    if (!isByHand(k)) continue;
    QColor line = colors().left_out;
    line.setAlpha(130);
    drawBand(k, width, hatched(line));
  }
}

void AngleDistancePlot::drawBand(std::size_t bin, double width_deg, const QBrush& brush) {
  auto* band = new QCPItemRect(this);
  band->setLayer("bands");
  band->setPen(Qt::NoPen);
  band->setBrush(brush);
  band->topLeft->setTypeY(QCPItemPosition::ptAxisRectRatio);
  band->bottomRight->setTypeY(QCPItemPosition::ptAxisRectRatio);
  band->topLeft->setCoords(-180.0 + width_deg * static_cast<double>(bin), 0.0);
  band->bottomRight->setCoords(-180.0 + width_deg * static_cast<double>(bin + 1), 1.0);
}

void AngleDistancePlot::drawSamples() {
  const std::size_t step =
      compact_ ? std::max<std::size_t>(1, data_.samples.size() / kSmallSamples) : 1;
  std::array<QVector<double>, kIntensityLevels> angles;
  std::array<QVector<double>, kIntensityLevels> distances;
  const ColorScale& scale = data_.intensity;
  const double width = std::max(scale.high - scale.low, 1e-9);
  for (std::size_t i = 0; i < data_.samples.size(); i += step) {
    const NodeSample& s = data_.samples[i];
    const double share = std::clamp((s.intensity - scale.low) / width, 0.0, 1.0);
    const auto level = static_cast<std::size_t>(std::lround(share * (kIntensityLevels - 1)));
    angles[level].push_back(kDegPerRad * s.angle_rad);
    distances[level].push_back(kMmPerM * s.distance_m);
  }
  for (std::size_t level = 0; level < kIntensityLevels; ++level) {
    if (angles[level].isEmpty()) continue;
    QCPGraph* graph = addGraph();
    // The end of the scale that would vanish into the ground is left out.
    const double along = static_cast<double>(level) / (kIntensityLevels - 1);
    const double share = colors().dark ? 0.22 + 0.78 * along : 0.92 * along;
    const QColor color = QColor::fromRgb(map_color(scale.map, share));
    graph->setLineStyle(QCPGraph::lsNone);
    graph->setAdaptiveSampling(false);
    graph->setScatterStyle(compact_ ? QCPScatterStyle(QCPScatterStyle::ssSquare, color, color, 1.6)
                                    : QCPScatterStyle(QCPScatterStyle::ssSquare, color, color, 3));
    graph->setAntialiasedScatters(false);
    graph->setData(angles[level], distances[level]);
  }
}

void AngleDistancePlot::drawWave() {
  QCPGraph* zero = addGraph();
  zero->setPen(QPen(colors().zero, 1, Qt::DashLine));
  zero->setData({-180.0, 180.0}, {0.0, 0.0});
  if (data_.record.bins.empty() || data_.record.wave_m.isZero()) return;
  QVector<double> angles;
  QVector<double> distances;
  for (int degree = -180; degree <= 180; degree += 3) {
    const double psi = degree / kDegPerRad;
    const Eigen::Vector3d basis(std::cos(psi), std::sin(psi), 1.0);
    angles.push_back(degree);
    distances.push_back(kMmPerM * basis.dot(data_.record.wave_m));
  }
  QCPGraph* wave = addGraph();
  wave->setPen(QPen(colors().fit, compact_ ? 1.6 : 2.2));
  wave->setData(angles, distances);
}

void AngleDistancePlot::drawBins() {
  QCPGraph* used = addGraph();
  QCPGraph* refused = addGraph();
  QCPGraph* by_hand = addGraph();
  for (std::size_t k = 0; k < data_.record.bins.size(); ++k) {
    const BinRecord& bin = data_.record.bins[k];
    QCPGraph* unused = isByHand(k) ? by_hand : refused;
    const bool has_midpoint = bin.state == BinState::kUsed || bin.state == BinState::kOutlier ||
                              bin.state == BinState::kWeakContrast;
    if (has_midpoint) {
      (bin.state == BinState::kUsed ? used : unused)
          ->addData(kDegPerRad * bin.angle_rad, kMmPerM * bin.midpoint_m);
    } else {
      // No midpoint: a cross on the zero line says that the bin was looked at.
      unused->addData(kDegPerRad * bin.angle_rad, 0.0);
    }
  }
  const double size = compact_ ? 4 : 7;
  used->setLineStyle(QCPGraph::lsNone);
  used->setScatterStyle(
      {QCPScatterStyle::ssCircle, QPen(colors().mark), colors().background, size});
  for (const auto& [graph, color] :
       {std::pair(refused, colors().refused), std::pair(by_hand, colors().left_out)}) {
    graph->setLineStyle(QCPGraph::lsNone);
    graph->setScatterStyle({QCPScatterStyle::ssCross, QPen(color, 1.5), Qt::NoBrush, size + 1});
  }
  auto* bars = new QCPErrorBars(xAxis, yAxis);
  bars->setDataPlottable(used);
  bars->setPen(QPen(colors().mark));
  bars->setWhiskerWidth(compact_ ? 3 : 6);
  bars->setSymbolGap(0);
  for (const BinRecord& bin : data_.record.bins) {
    if (bin.state == BinState::kUsed) bars->addData(kMmPerM * bin.sigma_m);
  }
}

void AngleDistancePlot::explain() {
  using Sign = LegendEntry::Sign;
  const auto tone = [&](double share) {
    return QColor::fromRgb(map_color(data_.intensity.map, share));
  };
  std::vector<LegendEntry> entries = {
      {Sign::kDot, tone(colors().dark ? 0.22 : 0.0), tr("dark sample")},
      {Sign::kDot, tone(colors().dark ? 1.0 : 0.92), tr("bright sample")},
      {Sign::kMark, colors().mark, tr("edge in a bin, ±1σ")},
      {Sign::kLine, colors().fit, tr("fitted wave")}};
  if (std::find(data_.by_hand.begin(), data_.by_hand.end(), true) != data_.by_hand.end())
    entries.push_back({Sign::kBox, colors().left_out, tr("left out by hand")});
  showLegend(std::move(entries));
}

// Hatched and crossed out, as circles that are not used are in the image.
void AngleDistancePlot::drawRefusal() {
  if (!refused_) return;
  const auto ratio = [](QCPItemPosition* position, double x, double y) {
    position->setType(QCPItemPosition::ptAxisRectRatio);
    position->setCoords(x, y);
  };
  QColor pale = refusalColor();
  pale.setAlpha(90);
  auto* hatch = new QCPItemRect(this);
  ratio(hatch->topLeft, 0.0, 0.0);
  ratio(hatch->bottomRight, 1.0, 1.0);
  hatch->setPen(Qt::NoPen);
  hatch->setBrush(hatched(pale));
  for (const bool down : {true, false}) {
    auto* line = new QCPItemLine(this);
    ratio(line->start, 0.0, down ? 0.0 : 1.0);
    ratio(line->end, 1.0, down ? 1.0 : 0.0);
    line->setPen(QPen(refusalColor(), 1.6));
  }
}

void AngleDistancePlot::drawLabel() {
  if (title_.isEmpty()) return;
  auto* label = new QCPItemText(this);
  label->position->setType(QCPItemPosition::ptAxisRectRatio);
  label->position->setCoords(0.02, 0.03);
  label->setPositionAlignment(Qt::AlignLeft | Qt::AlignTop);
  label->setText(title_);
  label->setPadding(QMargins(3, 1, 3, 1));
  QColor ground = colors().background;
  ground.setAlpha(215);
  label->setBrush(ground);
  const bool fine = !refused_ && (data_.record.valid || data_.record.bins.empty());
  label->setColor(fine ? colors().text : refusalColor());
  QFont bold = font();
  bold.setBold(true);
  label->setFont(bold);
}

std::vector<QStringList> AngleDistancePlot::tableRows() const {
  std::vector<QStringList> rows;
  for (std::size_t k = 0; k < data_.record.bins.size(); ++k) {
    const BinRecord& bin = data_.record.bins[k];
    rows.push_back({QString("bin"),
                    csv_number(kDegPerRad * bin.angle_rad),
                    csv_number(kMmPerM * bin.midpoint_m),
                    csv_number(kMmPerM * bin.sigma_m),
                    QString::number(bin.samples),
                    isByHand(k) ? tr("left out by hand") : core_text(describe(bin.state)),
                    {}});
  }
  for (const NodeSample& s : data_.samples) {
    rows.push_back({QString("sample"),
                    csv_number(kDegPerRad * s.angle_rad),
                    csv_number(kMmPerM * s.distance_m),
                    {},
                    {},
                    {},
                    csv_number(s.intensity)});
  }
  return rows;
}

}  // namespace lvcalib::widgets

#include "moc_angle_distance_plot.cpp"
