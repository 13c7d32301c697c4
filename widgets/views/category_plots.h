// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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
  using CategoryPlot::CategoryPlot;
  void setBars(std::vector<Bar> bars, const QString& message = {});

 protected:
  void rebuild() override;

 private:
  std::vector<Bar> bars_;
  QString message_;
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
