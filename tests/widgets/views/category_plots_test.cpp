// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/category_plots.h"

#include <QSignalSpy>
#include <QTest>
#include <cmath>

#include <gtest/gtest.h>

#include "widgets/views/plots_test.h"

namespace lvcalib::widgets::category_plots_test {
namespace {

TEST(BarPlot, BarsAndClicks) {
  BarPlot plot;
  plot.setValueLabel("corner RMS (px)", "rms_px");
  plot.resize(400, 300);
  plot.setBars({{"A", 0.2, true}, {"B", 0.4, true}, {"C", std::nan(""), false}});
  plot.show();
  EXPECT_TRUE(test::shows(plot, plot.colors().fill));
  EXPECT_GE(plot.yAxis->range().upper, 0.4);
  const auto rows = test::rows_of(plot.csv());
  ASSERT_EQ(rows.size(), 3);
  EXPECT_EQ(rows[1], "B,0.4,1");
  QSignalSpy clicked(&plot, &CategoryPlot::categoryClicked);
  QTest::mouseClick(&plot, Qt::LeftButton, {},
                    QPoint(static_cast<int>(plot.xAxis->coordToPixel(2)), 150));
  ASSERT_EQ(clicked.size(), 1);
  EXPECT_EQ(clicked[0][0].toInt(), 1);
}

TEST(BarPlot, TheLineIsDraggedAndBarsAboveItAreRed) {
  BarPlot plot;
  plot.setValueLabel("RMS (px)", "rms_px");
  plot.resize(400, 300);
  plot.setBars({{"A", 1.0, true}, {"B", 4.0, true}, {"C", 3.0, false}});
  plot.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&plot));
  const auto at = [&](double y) {
    return QPoint(200, static_cast<int>(std::lround(plot.yAxis->coordToPixel(y))));
  };
  QTest::mousePress(&plot, Qt::LeftButton, {}, at(4.2));
  QTest::mouseMove(&plot, at(2.0));
  QTest::mouseRelease(&plot, Qt::LeftButton, {}, at(2.0));
  EXPECT_FALSE(plot.threshold().has_value()) << "there is no line yet";
  plot.setBars({{"A", 1.0, true}, {"B", 4.0, true}, {"C", 3.0, false}});
  plot.setThresholdShown(true);
  EXPECT_TRUE(plot.beyond().empty());
  QTest::qWait(20);
  QSignalSpy moved(&plot, &BarPlot::thresholdMoved);
  QTest::mousePress(&plot, Qt::LeftButton, {}, at(4.2));
  QTest::mouseMove(&plot, at(2.0));
  QTest::mouseRelease(&plot, Qt::LeftButton, {}, at(2.0));
  ASSERT_TRUE(plot.threshold().has_value());
  EXPECT_NEAR(*plot.threshold(), 2.0, 0.1);
  EXPECT_EQ(plot.beyond(), std::vector<int>{1});  // The third is not used anyway.
  EXPECT_TRUE(test::shows(plot, plot.colors().refused));
  EXPECT_GE(moved.count(), 1);
  for (int k = 0; k < 60; ++k) QTest::keyClick(&plot, Qt::Key_Up);
  EXPECT_FALSE(plot.threshold().has_value());
  plot.setThreshold(0.5);
  plot.setBars({{"A", 1.0, true}});
  EXPECT_FALSE(plot.threshold().has_value()) << "other bars, another question";
}

TEST(BarPlot, ManyNamesAreTurned) {
  BarPlot plot;
  std::vector<BarPlot::Bar> bars;
  for (int k = 0; k < 30; ++k) bars.push_back({QString("scene %1").arg(k), 1.0, true});
  plot.setBars(bars);
  EXPECT_LT(plot.xAxis->tickLabelRotation(), 0.0);
}

TEST(BoxPlot, BoxesFromValues) {
  BoxPlot plot;
  plot.setValueLabel("residual (mm)", "residual_mm");
  plot.resize(400, 300);
  plot.setBoxes({{"A", {1, 2, 3, 4, 5, 40}}, {"B", {}}});
  EXPECT_TRUE(test::shows(plot, plot.colors().fill));
  EXPECT_TRUE(test::shows(plot, plot.colors().fit));  // The median.
  EXPECT_GE(plot.yAxis->range().upper, 40.0);         // Outliers are in sight.
  EXPECT_EQ(test::rows_of(plot.csv()).size(), 6);
}

TEST(BoxPlot, WhatIsRefusedStandsBesideTheBoxInRed) {
  BoxPlot plot;
  plot.setValueLabel("residual (mm)", "residual_mm");
  plot.resize(400, 300);
  plot.setBoxes({{"A", {1, 2, 3, 4, 5, 40}}});
  EXPECT_FALSE(test::shows(plot, plot.colors().refused)) << "an outlier is used";
  plot.setBoxes({{"A", {1, 2, 3, 4, 5}, {60.0}}});
  EXPECT_TRUE(test::shows(plot, plot.colors().refused));
  EXPECT_GE(plot.yAxis->range().upper, 7.0);
  EXPECT_LT(plot.yAxis->range().upper, 10.0) << "the box must not be flattened";
  EXPECT_TRUE(plot.csv().contains("A,60,0"));
  EXPECT_TRUE(plot.csv().contains("A,5,1"));
}

TEST(BoxPlot, EmptySaysWhy) {
  BoxPlot plot;
  plot.resize(300, 200);
  plot.setBoxes({}, "this board has no circles");
  EXPECT_GT(test::colours_shown(plot), 3);
}

}  // namespace
}  // namespace lvcalib::widgets::category_plots_test
