// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QString>
#include <utility>
#include <vector>

#include "views/custom_plot.h"

namespace lvcalib::widgets {

/// One line of a legend: a sign as it is drawn in the figure, and what it stands for.
struct LegendEntry {
  enum class Sign {
    kLine,
    kDashed,
    kDot,   ///< A filled mark.
    kMark,  ///< An open mark.
    kBox,   ///< Bars and areas.
    kArrow,
  };
  Sign sign = Sign::kLine;
  QColor color;
  QString text;
  /// Of a line that stands for several, each in a colour of its own: the colours of others.
  std::vector<QColor> others = {};
};

/// A legend above a figure: entries side by side, in as many lines as they need, so that they lie
/// over nothing that is drawn. Part of the figure: it is saved with it. In a figure that is too low
/// for it there is none.
class PlotLegend : public QCPLayoutElement {
 public:
  /// Takes a row of its own at the top of the plot's layout.
  explicit PlotLegend(QCustomPlot* plot);

  void setEntries(std::vector<LegendEntry> entries, const QFont& font, const QColor& text);
  [[nodiscard]] const std::vector<LegendEntry>& entries() const { return entries_; }
  [[nodiscard]] bool isShown() const;

  [[nodiscard]] QSize minimumOuterSizeHint() const override;
  [[nodiscard]] QSize maximumOuterSizeHint() const override;

 protected:
  void draw(QCPPainter* painter) override;
  void applyDefaultAntialiasingHint(QCPPainter* painter) const override;

 private:
  [[nodiscard]] int lineHeight() const;
  /// Upper left corner of each entry in a row of this width, and the height of all.
  [[nodiscard]] std::pair<std::vector<QPoint>, int> arranged(int width) const;

  std::vector<LegendEntry> entries_;
  QFont font_;
  QColor text_;
};

}  // namespace lvcalib::widgets
