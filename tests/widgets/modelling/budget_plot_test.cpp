// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/budget_plot.h"

#include <gtest/gtest.h>

#include "model_example.h"

namespace lvcalib::widgets::budget_plot_test {
namespace {

const ChannelSummary& range_of(const ModelStep& step) {
  for (const ChannelSummary& c : step.channels) {
    if (c.channel == Channel::kRange) return c;
  }
  throw std::runtime_error("no range channel");
}

TEST(BudgetPlotTest, SharesAddUpAndTheUnexplainedOneFalls) {
  const auto& example = test::model_example();
  const auto before = BudgetPlot::shares(range_of(*example.base), range_of(*example.base));
  EXPECT_NEAR(before.floor + before.explained + before.unexplained, 1.0, 0.02);
  EXPECT_NEAR(before.explained, 0.0, 0.02);
  EXPECT_GT(before.unexplained, 0.1);
  const auto after = BudgetPlot::shares(range_of(*example.base), range_of(*example.mended));
  EXPECT_LT(after.unexplained, 0.1 * before.unexplained);
  EXPECT_NEAR(after.explained, before.unexplained, 0.05);
  EXPECT_LT(after.heldout, before.heldout);
  EXPECT_EQ(BudgetPlot::shares({}, {}).floor, 0.0);
}

TEST(BudgetPlotTest, AClickOnAColumnGoesToItsStep) {
  const auto& example = test::model_example();
  BudgetPlot plot;
  plot.resize(600, 160);
  plot.setSteps({example.base, example.mended}, 1);
  plot.show();
  plot.replot();
  QSignalSpy clicked(&plot, &BudgetPlot::stepClicked);
  const auto click = [&](double x) {
    const QPoint at(static_cast<int>(plot.xAxis->coordToPixel(x)), 80);
    QTest::mouseClick(&plot, Qt::LeftButton, {}, at);
  };
  click(0.0);
  ASSERT_EQ(clicked.count(), 1);
  EXPECT_EQ(clicked.last().at(0).toInt(), 0);
  click(4.0);  // Second channel, second step.
  ASSERT_EQ(clicked.count(), 2);
  EXPECT_EQ(clicked.last().at(0).toInt(), 1);
  click(2.0);  // Between channels.
  EXPECT_EQ(clicked.count(), 2);
  EXPECT_TRUE(plot.csv().startsWith("step,channel,rms"));
}

TEST(BudgetPlotTest, IsEmptyWithoutSteps) {
  BudgetPlot plot;
  plot.setSteps({}, 0);
  EXPECT_EQ(plot.itemCount(), 1);
  EXPECT_TRUE(plot.csv().isEmpty());
}

}  // namespace
}  // namespace lvcalib::widgets::budget_plot_test
