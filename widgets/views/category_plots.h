// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "base/statistics.h"
#include "views/plot_view.h"

namespace lvcalib::widgets {

/// Base of plots with named columns; clicking a column names it.
class CategoryPlot : public PlotView {
  Q_OBJECT

 public:
  explicit CategoryPlot(QWidget* parent = nullptr);
  /// Label of the value axis, with its unit, and the name of its column in CSV files.
  void setValueLabel(const QString& label, const QString& csv_name);
  void setChosen(int index);

 Q_SIGNALS:
  void categoryClicked(int index);

 protected:
  /// Ticks for the names and the range for values between `low` and `high`.
  void layoutColumns(const QStringList& names, double low, double high);
  [[nodiscard]] int chosen() const { return chosen_; }
  [[nodiscard]] const QString& csvName() const { return csv_name_; }

 private:
  int columns_ = 0;
  int chosen_ = -1;
  QString csv_name_;
};

/// Bars of one or two values per name.
class BarPlot : public CategoryPlot {
  Q_OBJECT

 public:
  struct Bar {
    QString name;
    double value = 0.0;
    bool used = true;  ///< Bars of what is not used are drawn pale.
  };
  explicit BarPlot(QWidget* parent = nullptr);
  void setBars(std::vector<Bar> bars, const QString& message = {});
  /// A line over the bars that can be dragged, at first above them all. With new bars it is there
  /// again.
  void setThresholdShown(bool shown);
  /// None: above all bars.
  void setThreshold(std::optional<double> threshold);
  [[nodiscard]] std::optional<double> threshold() const { return threshold_; }
  /// Bars in use that rise above the line, by their place.
  [[nodiscard]] std::vector<int> beyond() const;

 Q_SIGNALS:
  /// The user moves the line: while it is dragged, and at the end.
  void thresholdMoved();

 protected:
  void rebuild() override;
  void keyPressEvent(QKeyEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  void drawThreshold();
  void moveTo(double threshold);
  [[nodiscard]] double lineAt() const;
  [[nodiscard]] bool isNearLine(const QPointF& place) const;

  std::vector<Bar> bars_;
  QString message_;
  bool threshold_shown_ = false;
  bool dragging_ = false;
  double highest_ = 0.0;  // Of the bars.
  std::optional<double> threshold_;
};

/// Box plots of values per name (Tukey).
class BoxPlot : public CategoryPlot {
  Q_OBJECT

 public:
  struct Box {
    QString name;
    std::vector<double> values;
    std::vector<double> refused = {};  ///< Crosses beside the box, and no part of it.
  };
  using CategoryPlot::CategoryPlot;
  void setBoxes(std::vector<Box> boxes, const QString& message = {});

 protected:
  void rebuild() override;

 private:
  std::vector<Box> boxes_;
  QString message_;
};

}  // namespace lvcalib::widgets
