// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/sample_map_plot.h"

#include <algorithm>

#include "base/units.h"
#include "style/swatch.h"
#include "style/texts.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

constexpr std::size_t kMostMapDots = 12'000;

}  // namespace

SampleMapPlot::SampleMapPlot(QWidget* parent) : BoardFigure(parent) {
  figureActions()->setName("boundary-samples");
  follow_language(this, [this] {
    setToolTip(tr(
        "The board from the front with the returns about its circles (of many, some), blue "
        "those of the overlap region. Dashed red: circles that are left out in one "
        "of the scenes shown; hatched: where something seems to cover the board; violet: what is "
        "left out by hand. The reasons are in the table below."));
  });
  connect(selectionRect(), &QCPSelectionRect::accepted, this, [this](const QRect& rect) {
    const QRect r = rect.normalized();
    const auto at = [this](const QPoint& p) -> Eigen::Vector2d {
      return Eigen::Vector2d(xAxis->pixelToCoord(p.x()), yAxis->pixelToCoord(p.y())) / kMmPerM;
    };
    Q_EMIT brushed({at(r.bottomLeft()), at(r.topRight())});
  });
}

void SampleMapPlot::setPart(const std::optional<BoardOutline>& part) {
  part_ = part;
  rebuild();
}

void SampleMapPlot::setScope(const ResponseScope& scope) {
  scope_ = scope;
  rebuild();
}

void SampleMapPlot::rebuild() {
  clearFigure();
  drawOutlines([this](const TargetNode& node) {
    if (isByHand(node.id)) return QPen(colors().left_out, 1.8, Qt::DashLine);
    return isRefused(node.id) ? QPen(colors().refused, 1.8, Qt::DashLine) : QPen(colors().axis);
  });
  for (const BoardOutline& part : scope_.covered)
    drawRectangle(part.lower_left_m, part.upper_right_m, hatched(colors().refused));
  for (const auto& patch : scope_.left_out_m) drawPatch(patch);
  if (part_) {
    QColor marked = colors().emphasis;
    marked.setAlpha(60);
    drawRectangle(part_->lower_left_m, part_->upper_right_m, marked);
  }
  QCPGraph* graphs[2];
  for (const bool overlap : {false, true}) {
    QColor color = overlap ? colors().emphasis : colors().axis;
    color.setAlpha(overlap ? 255 : 110);
    graphs[overlap] = addGraph();
    graphs[overlap]->setLineStyle(QCPGraph::lsNone);
    graphs[overlap]->setPen(Qt::NoPen);
    graphs[overlap]->setScatterStyle({QCPScatterStyle::ssCircle, QPen(Qt::NoPen), color, 2.2});
  }
  const std::vector<const BoundarySample*> samples = scope_.samples(false, kMostMapDots);
  for (const BoundarySample* s : samples) {
    const Eigen::Vector2d p = kMmPerM * s->board_m.cast<double>();
    graphs[s->overlap]->addData(p.x(), p.y());
  }
  using Sign = LegendEntry::Sign;
  std::vector<LegendEntry> entries = {{Sign::kDot, colors().axis, tr("samples")},
                                      {Sign::kDot, colors().emphasis, tr("overlap region")}};
  const auto& nodes = target().nodes();
  if (std::any_of(nodes.begin(), nodes.end(),
                  [&](const TargetNode& node) { return isRefused(node.id) && !isByHand(node.id); }))
    entries.push_back({Sign::kDashed, colors().refused, tr("circles left out")});
  if (!scope_.covered.empty()) entries.push_back({Sign::kBox, colors().refused, tr("covered")});
  if (!scope_.left_out_m.empty() || !scope_.left_out_circles.empty())
    entries.push_back({Sign::kBox, colors().left_out, tr("left out by hand")});
  if (!samples.empty()) showLegend(std::move(entries));
  if (samples.empty())
    showMessage(scope_.reason.empty() ? tr("no data") : core_text(scope_.reason));
  setTable({"x_mm", "y_mm", "distance_mm", "intensity", "overlap"}, [this] { return tableRows(); });
  replot(rpQueuedReplot);
}

std::vector<QStringList> SampleMapPlot::tableRows() const {
  std::vector<QStringList> rows;
  for (const BoundarySample* s : scope_.samples(false, kMostMapDots)) {
    const Eigen::Vector2d p = kMmPerM * s->board_m.cast<double>();
    rows.push_back({csv_number(p.x()), csv_number(p.y()),
                    csv_number(kMmPerM * static_cast<double>(s->distance_m)),
                    csv_number(static_cast<double>(s->intensity)), s->overlap ? "1" : "0"});
  }
  return rows;
}

void SampleMapPlot::drawPatch(const std::vector<Eigen::Vector2d>& edge_m) {
  auto* curve = new QCPCurve(xAxis, yAxis);
  curve->setPen(QPen(colors().left_out));
  curve->setBrush(hatched(colors().left_out));
  for (std::size_t k = 0; k <= edge_m.size() && !edge_m.empty(); ++k) {
    const Eigen::Vector2d p = kMmPerM * edge_m[k % edge_m.size()];
    curve->addData(p.x(), p.y());
  }
}

bool SampleMapPlot::isByHand(int id) const {
  return std::find(scope_.left_out_circles.begin(), scope_.left_out_circles.end(), id) !=
         scope_.left_out_circles.end();
}

bool SampleMapPlot::isRefused(int id) const {
  return std::any_of(scope_.scenes.begin(), scope_.scenes.end(), [&](const SceneResponse* scene) {
    return std::any_of(scene->nodes.begin(), scene->nodes.end(), [&](const NodeResponse& node) {
      return node.id == id && node.state != NodeResponseState::kUsed;
    });
  });
}

}  // namespace lvcalib::widgets

#include "moc_sample_map_plot.cpp"
