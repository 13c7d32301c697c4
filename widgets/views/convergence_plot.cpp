// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/convergence_plot.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "style/texts.h"

namespace lvcalib::widgets {
namespace {

// What a logarithmic axis can still show: a tenth of a micrometre.
constexpr double kSmallestMm = 1e-4;

}  // namespace

ConvergencePlot::ConvergencePlot(QWidget* parent) : PlotView(parent) {
  figureActions()->setName("convergence");
  yAxis->setScaleType(QCPAxis::stLogarithmic);
  yAxis->setTicker(QSharedPointer<QCPAxisTickerLog>(new QCPAxisTickerLog));
  yAxis->setNumberFormat("g");  // 10, not 10¹ beside a plain 1.
  showWholeNumbers(*xAxis);
  follow_language(this, [this] {
    xAxis->setLabel(tr("iteration"));
    yAxis->setLabel(tr("move (mm)"));
    setToolTip(
        tr("Thin lines: size of each circle's own correction in every iteration (mm), which "
           "ends at its measurement noise. Thick line: largest move of a centre after the "
           "projection to the layout; the refinement ends when it is small."));
  });
  connect(this, &PlotView::clicked, this, [this](const QPointF& place) {
    const int k = static_cast<int>(std::lround(xAxis->pixelToCoord(place.x())));
    if (k >= 1 && k <= static_cast<int>(history_.size())) Q_EMIT iterationClicked(k - 1);
  });
}

void ConvergencePlot::setHistory(std::vector<IterationRecord> history) {
  history_ = std::move(history);
  double low = 1.0;
  double high = 0.1;
  for (const IterationRecord& iteration : history_) {
    const auto widen = [&](double mm) {
      low = std::min(low, std::max(mm, kSmallestMm));
      high = std::max(high, mm);
    };
    widen(kMmPerM * iteration.max_update_m);
    for (const NodeRecord& node : iteration.nodes) {
      if (node.valid) widen(kMmPerM * node.wave_m.head<2>().norm());
    }
  }
  setHome({0.5, std::max(2.0, static_cast<double>(history_.size())) + 0.5},
          {0.6 * low, 1.8 * high});
  rebuild();
}

void ConvergencePlot::setIteration(int iteration) {
  iteration_ = iteration;
  rebuild();
}

void ConvergencePlot::setChosenNode(int id) {
  chosen_ = id;
  rebuild();
}

void ConvergencePlot::rebuild() {
  clearFigure();
  if (history_.empty()) showMessage(tr("no iterations"));
  if (iteration_ >= 0) {
    auto* line = new QCPItemStraightLine(this);
    line->point1->setCoords(iteration_ + 1, 1.0);
    line->point2->setCoords(iteration_ + 1, 2.0);
    line->setPen(QPen(colors().zero, 1, Qt::DashLine));
  }
  drawNodes();
  drawLayoutMoves();
  if (!history_.empty()) {
    showLegend({circlesEntry(), {LegendEntry::Sign::kLine, colors().mark, tr("layout")}});
  }
  fillTable();
  replot(rpQueuedReplot);
}

// Every circle has a colour of its own; one that is chosen is named in its colour.
LegendEntry ConvergencePlot::circlesEntry() const {
  const int place = chosen_ >= 0 ? placeOf(chosen_) : -1;
  if (place >= 0)
    return {LegendEntry::Sign::kLine, colors().series(place), tr("circle %1").arg(chosen_)};
  LegendEntry entry{LegendEntry::Sign::kLine, colors().series(0), tr("each circle")};
  for (std::size_t n = 1; n < history_.front().nodes.size(); ++n)
    entry.others.push_back(colors().series(static_cast<int>(n)));
  return entry;
}

int ConvergencePlot::placeOf(int id) const {
  const auto& nodes = history_.front().nodes;
  const auto found = std::find_if(nodes.begin(), nodes.end(),
                                  [id](const NodeRecord& node) { return node.id == id; });
  return found == nodes.end() ? -1 : static_cast<int>(found - nodes.begin());
}

void ConvergencePlot::drawNodes() {
  if (history_.empty()) return;
  for (std::size_t n = 0; n < history_.front().nodes.size(); ++n) {
    const int id = history_.front().nodes[n].id;
    QCPGraph* graph = addGraph();
    graph->setPen(QPen(colors().series(static_cast<int>(n)), id == chosen_ ? 2.6 : 1.0));
    for (std::size_t k = 0; k < history_.size(); ++k) {
      if (n >= history_[k].nodes.size() || !history_[k].nodes[n].valid) continue;
      const double mm = kMmPerM * history_[k].nodes[n].wave_m.head<2>().norm();
      graph->addData(static_cast<double>(k + 1), std::max(mm, kSmallestMm));
    }
  }
}

void ConvergencePlot::drawLayoutMoves() {
  QCPGraph* graph = addGraph();
  graph->setPen(QPen(colors().mark, 2.2));
  graph->setScatterStyle({QCPScatterStyle::ssDisc, QPen(colors().mark), colors().mark, 5});
  for (std::size_t k = 0; k < history_.size(); ++k) {
    graph->addData(static_cast<double>(k + 1),
                   std::max(kMmPerM * history_[k].max_update_m, kSmallestMm));
  }
}

void ConvergencePlot::fillTable() {
  std::vector<QStringList> rows;
  for (std::size_t k = 0; k < history_.size(); ++k) {
    rows.push_back({QString::number(k + 1), QString("layout"),
                    csv_number(kMmPerM * history_[k].max_update_m)});
    for (const NodeRecord& node : history_[k].nodes) {
      if (!node.valid) continue;
      rows.push_back({QString::number(k + 1), QString::number(node.id),
                      csv_number(kMmPerM * node.wave_m.head<2>().norm())});
    }
  }
  setTable({"iteration", "node", "move_mm"}, std::move(rows));
}

}  // namespace lvcalib::widgets

#include "moc_convergence_plot.cpp"
