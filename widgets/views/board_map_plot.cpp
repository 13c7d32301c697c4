// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/board_map_plot.h"

#include <cmath>
#include <numbers>

#include "base/symmetric.h"
#include "base/units.h"
#include "style/texts.h"

namespace lvcalib::widgets {
namespace {

// 1, 2 or 5 times a power of ten, not above `wanted`.
double round_down(double wanted) {
  if (!(wanted > 1.0)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= wanted) return digit * power;
  }
  return power;
}

}  // namespace

BoardMapPlot::BoardMapPlot(QWidget* parent) : BoardFigure(parent) {
  figureActions()->setName("board-map");
  axisRect()->setupFullAxesBox(true);
  xAxis2->setTickLabels(false);
  yAxis2->setTickLabels(false);
  follow_language(this, [this] {
    setToolTip(
        tr("The board from the front. Lines: how each circle's centre moved from the first to "
           "the last iteration, enlarged. Ellipse: twice the standard deviation of the "
           "refined centre, enlarged alike. Cross: where the model has it."));
  });
  connect(this, &PlotView::clicked, this, &BoardMapPlot::emitNodeAt);
}

void BoardMapPlot::setPaths(std::vector<CenterPath> paths) {
  paths_ = std::move(paths);
  double longest = 0.0;
  for (const CenterPath& path : paths_) {
    if (!path.valid) continue;
    for (const Eigen::Vector2d& p : path.predicted_m) longest = std::max(longest, p.norm());
    longest = std::max(longest, path.final_m.norm());
  }
  enlargement_ = longest > 0 ? round_down(0.4 * target().tag_pitch_m() / longest) : 1.0;
  rebuild();
}

void BoardMapPlot::setIteration(int iteration) {
  iteration_ = iteration;
  rebuild();
}

void BoardMapPlot::setChosenNode(int id) {
  chosen_ = id;
  rebuild();
}

void BoardMapPlot::setRefused(std::set<int> ids, std::set<int> by_hand) {
  refused_ = std::move(ids);
  by_hand_ = std::move(by_hand);
  rebuild();
}

void BoardMapPlot::rebuild() {
  clearFigure();
  drawBoard();
  for (std::size_t k = 0; k < paths_.size(); ++k) drawPath(paths_[k], static_cast<int>(k));
  drawCaption();
  fillTable();
  replot(rpQueuedReplot);
}

void BoardMapPlot::drawBoard() {
  if (target().has_tags()) {
    for (const TargetTag& tag : target().tags()) {
      const auto corners = target().tag_corners_m(tag);
      drawRectangle(corners[0], corners[2], colors().grid);
    }
  }
  drawOutlines([this](const TargetNode& node) {
    const bool chosen = node.id == chosen_;
    return QPen(chosen ? colors().emphasis : colors().axis, chosen ? 2.5 : 1.0);
  });
}

void BoardMapPlot::drawPath(const CenterPath& path, int index) {
  const auto place = [&](const Eigen::Vector2d& offset) {
    return Eigen::Vector2d(kMmPerM * (path.board_m + enlargement_ * offset));
  };
  auto* model = addGraph();
  model->setLineStyle(QCPGraph::lsNone);
  model->setScatterStyle({QCPScatterStyle::ssCross, QPen(colors().zero), Qt::NoBrush, 7});
  model->addData(kMmPerM * path.board_m.x(), kMmPerM * path.board_m.y());
  const QColor unused = by_hand_.contains(path.id) ? colors().left_out : colors().refused;
  if (!path.valid) {
    model->setScatterStyle({QCPScatterStyle::ssCrossCircle, QPen(unused, 1.5), Qt::NoBrush, 11});
    return;
  }
  const int last = iteration_ < 0 ? static_cast<int>(path.predicted_m.size()) - 1 : iteration_;
  auto* curve = new QCPCurve(xAxis, yAxis);
  const QColor color = colors().series(index);
  curve->setPen(QPen(color, 1.6));
  curve->setScatterStyle({QCPScatterStyle::ssDisc, QPen(color), color, 3.5});
  for (int k = 0; k <= last && k < static_cast<int>(path.predicted_m.size()); ++k) {
    const Eigen::Vector2d p = place(path.predicted_m[static_cast<std::size_t>(k)]);
    curve->addData(p.x(), p.y());
  }
  const Eigen::Vector2d end = place(path.final_m);
  auto* refined = addGraph();
  refined->setLineStyle(QCPGraph::lsNone);
  refined->setScatterStyle({QCPScatterStyle::ssDiamond, QPen(colors().mark), color, 7});
  refined->addData(end.x(), end.y());
  drawEllipse(path, QPen(colors().mark, 1));
  if (!refused_.contains(path.id)) return;
  auto* cross = addGraph();
  cross->setLineStyle(QCPGraph::lsNone);
  cross->setScatterStyle({QCPScatterStyle::ssCrossCircle, QPen(unused, 1.8), Qt::NoBrush, 16});
  cross->addData(kMmPerM * path.board_m.x(), kMmPerM * path.board_m.y());
}

void BoardMapPlot::drawEllipse(const CenterPath& path, const QPen& pen) {
  const auto axes = axes_of(path.covariance_m2);
  const Eigen::Vector2d radii = 2.0 * axes.values.cwiseMax(0.0).cwiseSqrt();
  auto* curve = new QCPCurve(xAxis, yAxis);
  curve->setPen(pen);
  for (int k = 0; k <= 48; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 48;
    const Eigen::Vector2d on_ellipse =
        axes.vectors * Eigen::Vector2d(radii.x() * std::cos(angle), radii.y() * std::sin(angle));
    const Eigen::Vector2d p = kMmPerM * (path.board_m + enlargement_ * (path.final_m + on_ellipse));
    curve->addData(p.x(), p.y());
  }
}

void BoardMapPlot::drawCaption() {
  QString caption;
  if (!paths_.empty()) {
    caption = tr("paths ×%1").arg(enlargement_, 0, 'g', 6);
  } else if (!target().has_circles()) {
    caption = tr("no circles");
  }
  auto* text = new QCPItemText(this);
  text->position->setType(QCPItemPosition::ptAxisRectRatio);
  text->position->setCoords(0.02, 0.02);
  text->setPositionAlignment(Qt::AlignLeft | Qt::AlignTop);
  text->setColor(colors().text);
  text->setFont(font());
  text->setText(caption);
}

void BoardMapPlot::fillTable() {
  std::vector<QStringList> rows;
  for (const CenterPath& path : paths_) {
    const auto row = [&](const QString& kind, std::size_t k, const Eigen::Vector2d& p) {
      rows.push_back({QString::number(path.id), kind, QString::number(k),
                      csv_number(kMmPerM * p.x()), csv_number(kMmPerM * p.y())});
    };
    for (std::size_t k = 0; k < path.predicted_m.size(); ++k) {
      row("layout", k, path.predicted_m[k]);
      row("measured", k, path.measured_m[k]);
    }
    row("refined", path.predicted_m.size(), path.final_m);
  }
  setTable({"node", "kind", "iteration", "dx_mm", "dy_mm"}, std::move(rows));
}

void BoardMapPlot::emitNodeAt(const QPointF& place) {
  const Eigen::Vector2d p(xAxis->pixelToCoord(place.x()) / kMmPerM,
                          yAxis->pixelToCoord(place.y()) / kMmPerM);
  for (const TargetNode& node : target().nodes()) {
    if ((node.center_m - p).norm() < 0.35 * target().tag_pitch_m()) {
      Q_EMIT nodeClicked(node.id);
      return;
    }
  }
}

}  // namespace lvcalib::widgets

#include "moc_board_map_plot.cpp"
