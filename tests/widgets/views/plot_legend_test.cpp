// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/plot_legend.h"

#include <gtest/gtest.h>

#include "views/plot_view.h"
#include "widgets/views/plots_test.h"

namespace lvcalib::widgets::plot_legend_test {
namespace {

const QColor kBefore(10, 120, 220);
const QColor kAfter(220, 90, 10);

class Figure : public PlotView {
 public:
  using PlotView::showLegend;

 protected:
  void rebuild() override {}
};

// Rows of the picture in which a colour is found; −1, −1 if there is none.
std::pair<int, int> rows_of(QWidget& plot, const QColor& color) {
  const QImage image = plot.grab().toImage();
  std::pair<int, int> rows{-1, -1};
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (image.pixelColor(x, y) != color) continue;
      if (rows.first < 0) rows.first = y;
      rows.second = y;
      break;
    }
  }
  return rows;
}

TEST(PlotLegend, StandsAboveTheFigureAndOverNothingOfIt) {
  Figure plot;
  plot.resize(500, 300);
  plot.showLegend({{LegendEntry::Sign::kBox, kBefore, "before"},
                   {LegendEntry::Sign::kBox, kAfter, "with the effects"}});
  plot.replot();
  const auto rows = rows_of(plot, kBefore);
  EXPECT_GT(rows.first, 0);
  EXPECT_LT(rows.second, plot.axisRect()->top());
  EXPECT_EQ(rows, rows_of(plot, kAfter)) << "side by side";
  EXPECT_EQ(plot.legendEntries().size(), 2U);
}

TEST(PlotLegend, TakesAnotherLineWhereTheFigureIsNarrow) {
  Figure plot;
  plot.resize(150, 300);
  plot.showLegend({{LegendEntry::Sign::kBox, kBefore, "before the effects"},
                   {LegendEntry::Sign::kBox, kAfter, "with the effects"}});
  plot.replot();
  EXPECT_GT(rows_of(plot, kAfter).first, rows_of(plot, kBefore).second);
  EXPECT_LT(rows_of(plot, kAfter).second, plot.axisRect()->top());
}

// The figure itself matters more.
TEST(PlotLegend, GivesWayInALowFigure) {
  Figure plot;
  plot.resize(500, 90);
  plot.showLegend({{LegendEntry::Sign::kBox, kBefore, "before"}});
  plot.replot();
  EXPECT_EQ(rows_of(plot, kBefore).first, -1);
  EXPECT_GT(plot.axisRect()->height(), 30);
}

TEST(PlotLegend, GoesWithWhatItExplained) {
  Figure plot;
  plot.resize(500, 300);
  plot.replot();
  const int without = plot.axisRect()->top();
  plot.showLegend({{LegendEntry::Sign::kBox, kBefore, "before"}});
  plot.replot();
  EXPECT_GT(plot.axisRect()->top(), without);
  plot.showLegend({});
  plot.replot();
  EXPECT_LE(plot.axisRect()->top(), without + 8);
  EXPECT_EQ(rows_of(plot, kBefore).first, -1);
}

TEST(PlotLegend, SeveralLinesAreDrawnInTheirColours) {
  Figure plot;
  plot.resize(300, 300);
  plot.showLegend({{LegendEntry::Sign::kLine, kBefore, "each", {kAfter, Qt::black, Qt::green}}});
  plot.replot();
  EXPECT_TRUE(test::shows(plot, kBefore));
  EXPECT_TRUE(test::shows(plot, kAfter));
}

TEST(PlotLegend, EverySignIsDrawn) {
  using Sign = LegendEntry::Sign;
  for (const Sign sign :
       {Sign::kLine, Sign::kDashed, Sign::kDot, Sign::kMark, Sign::kBox, Sign::kArrow}) {
    Figure plot;
    plot.resize(300, 300);
    const QImage without = plot.grab().toImage();
    plot.showLegend({{sign, kBefore, {}}});
    plot.replot();
    int found = 0;
    const QImage image = plot.grab().toImage();
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 30; ++x) {
        const QColor c = image.pixelColor(x, y);
        if (c.blue() - c.red() > 60) ++found;
      }
    }
    EXPECT_GT(found, 8) << static_cast<int>(sign);
  }
}

}  // namespace
}  // namespace lvcalib::widgets::plot_legend_test
