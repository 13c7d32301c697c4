// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStringList>
#include <functional>
#include <vector>

#include "views/custom_plot.h"
#include "views/figure_actions.h"
#include "views/plot_colors.h"
#include "views/plot_legend.h"

namespace lvcalib::widgets {

/// A figure with axes: wheel zooms, dragging pans, a double click or Home shows everything again,
/// the context menu saves it. Draws what it is given; follows the palette. Base of all plots.
class PlotView : public QCustomPlot {
  Q_OBJECT

 public:
  explicit PlotView(QWidget* parent = nullptr);

  [[nodiscard]] FigureActions* figureActions() const { return actions_; }
  /// The data behind the figure as CSV text.
  [[nodiscard]] QByteArray csv() const;
  [[nodiscard]] const PlotColors& colors() const { return colors_; }
  /// What the figure says its colours and signs are; empty if nothing has to be said.
  [[nodiscard]] std::vector<LegendEntry> legendEntries() const;
  /// While brushing, a drag draws a rectangle instead of moving the figure.
  void setBrushing(bool brushing);

 public Q_SLOTS:
  /// Back to the whole range.
  void resetView();

 Q_SIGNALS:
  /// A plain click (not a drag) on the figure.
  void clicked(const QPointF& place);

 protected:
  /// Draws everything anew with colors(); called when palette or language change.
  virtual void rebuild() = 0;
  /// Empties the figure, keeping the axes.
  void clearFigure();
  /// Says in the middle of an empty figure why it is empty.
  void showMessage(const QString& text);
  /// Says above the figure what its colours and signs are, until it is drawn anew.
  void showLegend(std::vector<LegendEntry> entries);
  /// Counts have no numbers such as 2.5 on their axis.
  static void showWholeNumbers(QCPAxis& axis);
  /// Stores the range that resetView() goes back to, and shows it.
  void setHome(const QCPRange& x, const QCPRange& y);
  /// What csv() gives; `rows` is called only when somebody wants it.
  void setTable(const QStringList& header, std::function<std::vector<QStringList>()> rows);
  /// The same of a small table.
  void setTable(const QStringList& header, std::vector<QStringList> rows);

  void changeEvent(QEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

 private:
  void applyColors();
  /// Labels of upright axes get letters as small as a low figure needs.
  void fitLabels();
  void fitTicks();
  void fitMessage();
  [[nodiscard]] QByteArray pdf();

  FigureActions* actions_;
  PlotLegend* legend_row_ = nullptr;  // The layout's; made once there is something to say.
  PlotColors colors_;
  bool stale_ = false;       // Drawn with the colours or words before.
  bool old_colors_ = false;  // What has been drawn is not in the present ones.
  QCPRange home_x_, home_y_;
  QPointF pressed_;
  QStringList header_;
  std::function<std::vector<QStringList>()> rows_;
};

/// A number for CSV files: shortest text that reads back as the same double.
QString csv_number(double value);

}  // namespace lvcalib::widgets
