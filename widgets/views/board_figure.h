// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "target/target.h"
#include "views/plot_view.h"

namespace lvcalib::widgets {

/// The board from the front, in mm, with equal scales along both axes. Base of the figures over it.
class BoardFigure : public PlotView {
  Q_OBJECT

 public:
  explicit BoardFigure(QWidget* parent = nullptr);
  void setTarget(const Target& target);

 protected:
  [[nodiscard]] const Target& target() const { return target_; }
  /// A rectangle along the board's axes, its corners in metres.
  void drawRectangle(const Eigen::Vector2d& low_m, const Eigen::Vector2d& high_m,
                     const QBrush& brush);
  /// The board's outline and its circles, each with the pen that `pen` has for it.
  void drawOutlines(const std::function<QPen(const TargetNode&)>& pen);

 private:
  void fit();

  Target target_;
  QSize fitted_to_;
};

}  // namespace lvcalib::widgets
