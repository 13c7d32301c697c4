// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/board_figure.h"

#include <algorithm>

#include "base/units.h"
#include "style/texts.h"

namespace lvcalib::widgets {

BoardFigure::BoardFigure(QWidget* parent) : PlotView(parent) {
  follow_language(this, [this] {
    xAxis->setLabel(tr("board x (mm)"));
    yAxis->setLabel(tr("board y (mm)"));
  });
  connect(this, &QCustomPlot::afterLayout, this, [this] {
    if (axisRect()->size() == fitted_to_) return;
    fitted_to_ = axisRect()->size();
    fit();
    replot(rpQueuedReplot);  // The ticks of this one are made already.
  });
}

void BoardFigure::setTarget(const Target& target) {
  target_ = target;
  fit();
  rebuild();
}

// The board in the middle.
void BoardFigure::fit() {
  const BoardOutline outline = target_.outline();
  const Eigen::Vector2d center = kMmPerM * outline.center_m();
  const Eigen::Vector2d half = 0.54 * kMmPerM * outline.size_m();
  const QRect rect = axisRect()->rect();
  const double aspect =
      rect.height() > 10 ? static_cast<double>(rect.width()) / rect.height() : 1.0;
  const double half_y = std::max(half.y(), half.x() / aspect);
  setHome({center.x() - half_y * aspect, center.x() + half_y * aspect},
          {center.y() - half_y, center.y() + half_y});
}

void BoardFigure::drawRectangle(const Eigen::Vector2d& low_m, const Eigen::Vector2d& high_m,
                                const QBrush& brush) {
  auto* item = new QCPItemRect(this);
  item->topLeft->setCoords(kMmPerM * low_m.x(), kMmPerM * high_m.y());
  item->bottomRight->setCoords(kMmPerM * high_m.x(), kMmPerM * low_m.y());
  item->setPen(QPen(colors().axis));
  item->setBrush(brush);
}

void BoardFigure::drawOutlines(const std::function<QPen(const TargetNode&)>& pen) {
  const BoardOutline outline = target_.outline();
  drawRectangle(outline.lower_left_m, outline.upper_right_m, Qt::NoBrush);
  for (const TargetNode& node : target_.nodes()) {
    const double r = target_.circle_radius_m;
    auto* circle = new QCPItemEllipse(this);
    circle->topLeft->setCoords(kMmPerM * (node.center_m.x() - r),
                               kMmPerM * (node.center_m.y() + r));
    circle->bottomRight->setCoords(kMmPerM * (node.center_m.x() + r),
                                   kMmPerM * (node.center_m.y() - r));
    circle->setPen(pen(node));
  }
}

}  // namespace lvcalib::widgets

#include "moc_board_figure.cpp"
