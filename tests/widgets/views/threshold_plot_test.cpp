// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/threshold_plot.h"

#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

#include "widgets/views/plots_test.h"

namespace lvcalib::widgets::threshold_plot_test {
namespace {

class ThresholdPlotTest : public ::testing::Test {
 protected:
  void SetUp() override {
    plot_.resize(500, 250);
    plot_.setValueLabel("distance (σ)", "distance_sigmas");
    plot_.setValues({0.5, 1.0, 1.5, 2.0, 4.0, 6.0});
    plot_.setThreshold(5.0, 1.0, 1000.0);
    plot_.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&plot_));
  }
  [[nodiscard]] QPoint at(double value) const {
    return {static_cast<int>(std::lround(plot_.xAxis->coordToPixel(value))), 120};
  }
  [[nodiscard]] int refused() const {
    int out = 0;
    for (const QByteArray& row : test::rows_of(plot_.csv())) out += row.endsWith(",1") ? 1 : 0;
    return out;
  }
  ThresholdPlot plot_;
};

TEST_F(ThresholdPlotTest, TheLineIsDraggedAndWhatIsBeyondIsRefused) {
  QSignalSpy moved(&plot_, &ThresholdPlot::thresholdMoved);
  EXPECT_EQ(refused(), 1);
  QTest::mousePress(&plot_, Qt::LeftButton, {}, at(5.0));
  QTest::mouseMove(&plot_, at(3.0));
  QTest::mouseRelease(&plot_, Qt::LeftButton, {}, at(3.0));
  EXPECT_NEAR(plot_.threshold(), 3.0, 0.11);
  EXPECT_EQ(refused(), 2);
  EXPECT_GE(moved.count(), 1);
  EXPECT_EQ(moved.last().first().toDouble(), plot_.threshold());
}

// The solve has the last word where the line stands; elsewhere nobody knows yet.
TEST_F(ThresholdPlotTest, WhatIsRefusedIsSaidByTheSolveUntilTheLineMoves) {
  plot_.setValues({0.5, 4.0, 6.0, 7.0}, {}, {false, false, false, true});
  EXPECT_EQ(refused(), 1);
  QTest::keyClick(&plot_, Qt::Key_Right);
  EXPECT_EQ(refused(), 2);
}

// A full bar beyond the line would contradict the line.
TEST_F(ThresholdPlotTest, WhatIsKeptBeyondTheLineIsHatched) {
  const auto brushes = [&](Qt::BrushStyle style) {
    int out = 0;
    for (int k = 0; k < plot_.itemCount(); ++k) {
      const auto* rect = qobject_cast<QCPItemRect*>(plot_.item(k));
      out += rect != nullptr && rect->brush().style() == style ? 1 : 0;
    }
    return out;
  };
  plot_.setValues({0.5, 4.0, 6.0, 7.0}, {}, {false, false, false, true});
  EXPECT_EQ(brushes(Qt::TexturePattern), 1);
  EXPECT_EQ(brushes(Qt::SolidPattern), 3);
  QTest::keyClick(&plot_, Qt::Key_Right);
  EXPECT_EQ(brushes(Qt::TexturePattern), 0) << "nobody has kept it there yet";
}

TEST_F(ThresholdPlotTest, ADragElsewhereMovesNoLine) {
  QTest::mousePress(&plot_, Qt::LeftButton, {}, at(2.0));
  QTest::mouseMove(&plot_, at(1.0));
  QTest::mouseRelease(&plot_, Qt::LeftButton, {}, at(1.0));
  EXPECT_EQ(plot_.threshold(), 5.0);
}

TEST_F(ThresholdPlotTest, KeysMoveItWithinItsRange) {
  QTest::keyClick(&plot_, Qt::Key_Right);
  EXPECT_GT(plot_.threshold(), 5.0);
  for (int k = 0; k < 200; ++k) QTest::keyClick(&plot_, Qt::Key_Left);
  EXPECT_EQ(plot_.threshold(), 1.0);
}

TEST_F(ThresholdPlotTest, HowManyIsAWholeNumber) {
  for (const int most : {1, 2, 4, 7, 60}) {
    plot_.setValues(std::vector<double>(static_cast<std::size_t>(most), 0.5));
    plot_.replot();
    QVector<double> ticks;
    plot_.yAxis->ticker()->generate(plot_.yAxis->range(), QLocale::c(), 'g', 6, ticks, nullptr,
                                    nullptr);
    EXPECT_GE(ticks.size(), 2);
    for (const double tick : ticks) EXPECT_EQ(tick, std::round(tick)) << most;
  }
}

// Every figure is drawn a moment after the theme has changed; what it has drawn before does not
// stand on the new ground meanwhile.
TEST_F(ThresholdPlotTest, NothingInOldColoursStandsOnANewGround) {
  plot_.setPalette(test::palette_of(false));
  plot_.replot();
  EXPECT_GT(test::colours_shown(plot_), 3);
  plot_.setPalette(test::palette_of(true));
  EXPECT_EQ(test::colours_shown(plot_), 1);
  EXPECT_TRUE(QTest::qWaitFor([&] { return test::colours_shown(plot_) > 3; }, 2000));
}

TEST_F(ThresholdPlotTest, WithoutValuesItSaysWhy) {
  plot_.setValues({}, "no circles");
  EXPECT_TRUE(plot_.csv().isEmpty());
  QTest::keyClick(&plot_, Qt::Key_Plus);
}

}  // namespace
}  // namespace lvcalib::widgets::threshold_plot_test
