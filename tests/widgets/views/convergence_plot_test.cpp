// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/convergence_plot.h"

#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

#include "widgets/views/plots_test.h"

namespace lvcalib::widgets::convergence_plot_test {
namespace {

std::vector<IterationRecord> example() {
  std::vector<IterationRecord> history;
  for (int k = 0; k < 6; ++k) {
    IterationRecord iteration;
    iteration.max_update_m = 0.003 / std::pow(4.0, k);
    for (int n = 0; n < 9; ++n) {
      NodeRecord node;
      node.id = n;
      node.valid = n != 2;
      node.wave_m = {0.002 / (k + 1), 0.0, 0.0};
      iteration.nodes.push_back(node);
    }
    history.push_back(iteration);
  }
  return history;
}

TEST(ConvergencePlot, ShowsEveryValidNodeAndTheLayout) {
  ConvergencePlot plot;
  plot.resize(400, 300);
  plot.setHistory(example());
  const auto rows = test::rows_of(plot.csv());
  EXPECT_EQ(rows.size(), 6 * 9);
  EXPECT_EQ(rows[0], "1,layout,3");
  EXPECT_TRUE(test::shows(plot, plot.colors().mark));
  EXPECT_LT(plot.yAxis->range().lower, 3.0 / 1024);
  EXPECT_GT(plot.yAxis->range().upper, 3.0);
}

// One colour would stand for one circle.
TEST(ConvergencePlot, TheLegendHasTheColoursOfAllCirclesOrOfTheChosenOne) {
  ConvergencePlot plot;
  plot.resize(400, 300);
  plot.setHistory(example());
  const LegendEntry all = plot.legendEntries().front();
  EXPECT_EQ(all.color, plot.colors().series(0));
  ASSERT_EQ(all.others.size(), 8U);
  EXPECT_EQ(all.others.back(), plot.colors().series(8));
  plot.setChosenNode(4);
  const LegendEntry one = plot.legendEntries().front();
  EXPECT_EQ(one.color, plot.colors().series(4));
  EXPECT_TRUE(one.others.empty());
  EXPECT_TRUE(one.text.contains("4"));
}

TEST(ConvergencePlot, AClickNamesTheIteration) {
  ConvergencePlot plot;
  plot.resize(400, 300);
  plot.setHistory(example());
  plot.show();
  QSignalSpy clicked(&plot, &ConvergencePlot::iterationClicked);
  QTest::mouseClick(&plot, Qt::LeftButton, {},
                    QPoint(static_cast<int>(plot.xAxis->coordToPixel(3.1)), 120));
  ASSERT_EQ(clicked.size(), 1);
  EXPECT_EQ(clicked[0][0].toInt(), 2);
}

TEST(ConvergencePlot, NothingIsSaidToBeNothing) {
  ConvergencePlot plot;
  plot.setHistory({});
  EXPECT_TRUE(plot.csv().isEmpty());
}

}  // namespace
}  // namespace lvcalib::widgets::convergence_plot_test
