// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "views/plot_view.h"

namespace lvcalib::widgets {

/// A histogram of values with a threshold as a line that can be dragged, or moved with the arrow
/// keys; what lies beyond is drawn as refused.
class ThresholdPlot : public PlotView {
  Q_OBJECT

 public:
  explicit ThresholdPlot(QWidget* parent = nullptr);

  /// `label` of the values, with their unit, and the name of their column in CSV files.
  void setValueLabel(const QString& label, const QString& csv_name);
  /// `message` stands where there is nothing to show. `refused` says of each value whether it is
  /// refused where the line stands; without it, and once the line has moved on, that is taken from
  /// the side of the line on which it lies.
  void setValues(std::vector<double> values, const QString& message = {},
                 std::vector<bool> refused = {});
  /// Where the line stands, and where it may: `low` … `high`.
  void setThreshold(double threshold, double low, double high);
  [[nodiscard]] double threshold() const { return threshold_; }

 Q_SIGNALS:
  /// The user moves the line: while it is dragged, and at the end.
  void thresholdMoved(double threshold);

 protected:
  void rebuild() override;
  void keyPressEvent(QKeyEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  void moveTo(double threshold);
  [[nodiscard]] bool isNearLine(const QPointF& place) const;
  [[nodiscard]] double reach() const;

  std::vector<double> values_;
  std::vector<bool> refused_;  // As many, or none.
  QString message_;
  QString csv_name_;
  double threshold_ = 0.0;
  double low_ = 0.0;
  double high_ = 1.0;
  bool dragging_ = false;
};

}  // namespace lvcalib::widgets
