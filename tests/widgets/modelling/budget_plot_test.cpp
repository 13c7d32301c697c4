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

TEST(BudgetPlotTest, WhatIsUnexplainedFallsToWhatNoiseLeaves) {
  const auto& example = test::model_example();
  const auto before = BudgetPlot::beyond_noise(range_of(*example.base));
  EXPECT_FALSE(before.is_chance());
  EXPECT_NEAR(before.unexplained, range_of(*example.base).unexplained, 1e-12);
  const auto after = BudgetPlot::beyond_noise(range_of(*example.mended));
  EXPECT_LT(after.unexplained, 0.3 * before.unexplained);
  EXPECT_LT(after.heldout, before.heldout);
  // 1 ± 1.645·2/√10⁴ of the floor's square: √0.0329 of the floor.
  ChannelSummary c;
  c.n = 10'000;
  c.noise_floor = 10.0;
  c.unexplained = 1.8;
  EXPECT_NEAR(BudgetPlot::beyond_noise(c).by_chance, 1.8138, 1e-3);
  EXPECT_TRUE(BudgetPlot::beyond_noise(c).is_chance());
  c.unexplained = 1.9;
  EXPECT_FALSE(BudgetPlot::beyond_noise(c).is_chance());
}

// The demo's kind of effect is seen at a glance: half of the bar's height and more is red before.
TEST(BudgetPlotTest, TheFiguresSayBeforeAndAfter) {
  const auto& example = test::model_example();
  BudgetPlot plot;
  plot.setSteps({example.base, example.mended}, 1);
  const QString unexplained = QString::number(range_of(*example.base).unexplained, 'g', 2);
  bool seen = false;
  double red = 0.0;
  for (int k = 0; k < plot.itemCount(); ++k) {
    if (const auto* text = qobject_cast<QCPItemText*>(plot.item(k)))
      seen = seen || text->text().startsWith(unexplained + QStringLiteral(" → "));
    const auto* bar = qobject_cast<QCPItemRect*>(plot.item(k));
    if (bar != nullptr && bar->brush().color() == plot.colors().refused)
      red = std::max(red, bar->topLeft->coords().y());
  }
  EXPECT_TRUE(seen);
  EXPECT_GT(red, 0.5);
}

// The bars do not contradict the sentence beside them.
TEST(BudgetPlotTest, NothingIsRedWhereNothingIsMissing) {
  const auto& example = test::model_example();
  BudgetPlot plot;
  plot.setSteps({example.base}, 0);
  const auto is_red = [&] {
    for (int k = 0; k < plot.itemCount(); ++k) {
      const auto* bar = qobject_cast<QCPItemRect*>(plot.item(k));
      const auto* text = qobject_cast<QCPItemText*>(plot.item(k));
      if (bar != nullptr && bar->brush().color() == plot.colors().refused) return true;
      if (text != nullptr && text->color() == plot.colors().refused) return true;
    }
    return false;
  };
  EXPECT_FALSE(is_red()) << "nobody has looked yet";
  plot.setSomethingMissing(true);
  EXPECT_TRUE(is_red());
  plot.setSomethingMissing(false);
  EXPECT_FALSE(is_red());
}

// Also in a low and narrow figure, whatever its neighbours need.
TEST(BudgetPlotTest, NoFigureLeavesThePicture) {
  const auto& example = test::model_example();
  BudgetPlot plot;
  plot.setSteps({example.base, example.mended}, 1);
  plot.setTruth(Rigid3());
  for (const QSize& size : {QSize(930, 140), QSize(700, 100), QSize(1500, 200)}) {
    plot.resize(size);
    plot.replot();
    int texts = 0;
    for (int k = 0; k < plot.itemCount(); ++k) {
      const auto* text = qobject_cast<QCPItemText*>(plot.item(k));
      if (text == nullptr) continue;
      ++texts;
      const double half = 0.5 * QFontMetrics(text->font()).horizontalAdvance(text->text());
      EXPECT_LE(text->position->pixelPosition().x() + half, size.width()) << size.width();
    }
    EXPECT_GT(texts, 2);
    // The axis' name is no longer than the figure is high.
    EXPECT_LE(QFontMetrics(plot.yAxis->labelFont()).horizontalAdvance(plot.yAxis->label()),
              size.height());
  }
}

// What noise alone may leave, before and after, is no fall; and no frame stands about nothing.
TEST(BudgetPlotTest, WithinNoiseNothingChanges) {
  auto base = std::make_shared<ModelStep>(*test::model_example().base);
  auto next = std::make_shared<ModelStep>(*base);
  ASSERT_FALSE(base->channels.empty());
  base->channels.resize(1);
  next->channels.resize(1);
  ChannelSummary& before = base->channels.front();
  before.n = 10'000;
  before.noise_floor = 2.0;
  before.unexplained = 0.2;
  ASSERT_TRUE(BudgetPlot::beyond_noise(before).is_chance());
  next->channels.front() = before;
  next->channels.front().n = 2'500;
  next->channels.front().unexplained = 0.0;
  BudgetPlot plot;
  plot.setSteps({base, next}, 1);
  double highest = 0.0;
  for (int k = 0; k < plot.itemCount(); ++k) {
    if (const auto* text = qobject_cast<QCPItemText*>(plot.item(k)))
      EXPECT_FALSE(text->text().contains(QChar(u'→'))) << text->text().toStdString();
    const auto* frame = qobject_cast<QCPItemRect*>(plot.item(k));
    if (frame != nullptr && frame->pen() != Qt::NoPen)
      highest = std::max(highest, frame->topLeft->coords().y());
  }
  EXPECT_LE(highest, 0.05);
}

TEST(BudgetPlotTest, TheDistanceToTheTruthStandsBesideTheHistory) {
  const auto& example = test::model_example();
  BudgetPlot plot;
  plot.setSteps({example.base, example.mended}, 1);
  EXPECT_FALSE(plot.csv().contains("truth"));
  Rigid3 truth = example.mended->state.camera_from_lidar;
  truth.translation.x() += 0.003;
  plot.setTruth(truth);
  EXPECT_TRUE(plot.csv().contains("\n1,truth_mm,3"))  // To rounding.
      << plot.csv().toStdString();
  EXPECT_TRUE(plot.csv().contains("\n0,truth_mrad,"));
  bool seen = false;
  for (int k = 0; k < plot.itemCount(); ++k) {
    if (const auto* text = qobject_cast<QCPItemText*>(plot.item(k)))
      seen = seen || (text->text().contains("→ 3 mm") && text->text().endsWith("mrad"));
  }
  EXPECT_TRUE(seen);
  plot.setTruth(std::nullopt);
  EXPECT_FALSE(plot.csv().contains("truth"));
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
