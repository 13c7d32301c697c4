// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/report_figures.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lvcalib {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(ReportFigures, TextIsEscaped) {
  EXPECT_EQ(html_escaped("a<b>&\"c\"\x01"), "a&lt;b&gt;&amp;&quot;c&quot; ");
}

TEST(ReportFigures, NumbersThatAreNoneAreDashes) {
  EXPECT_EQ(shown(1.23456, 3), "1.23");
  EXPECT_EQ(shown(std::nan("")), "–");
  EXPECT_EQ(shown(HUGE_VAL), "–");
}

TEST(ReportFigures, TicksAreRoundAndInside) {
  const auto ticks = AxisRange{-0.73, 3.2}.ticks();
  ASSERT_GE(ticks.size(), 3U);
  EXPECT_LE(ticks.size(), 9U);
  for (const double t : ticks) {
    EXPECT_GE(t, -0.73);
    EXPECT_LE(t, 3.2);
    EXPECT_NEAR(t, std::round(t * 2.0) / 2.0, 1e-9);
  }
  EXPECT_EQ((AxisRange{2.0, 2.0}.ticks()), std::vector<double>{2.0});
}

TEST(ReportFigures, AxesHoldTheirValuesWhateverTheyAre) {
  const AxisRange axis = axis_about({3.0, -1.0, std::nan(""), HUGE_VAL});
  EXPECT_LT(axis.low, -1.0);
  EXPECT_GT(axis.high, 3.0);
  EXPECT_LT(axis.high, 4.0);
  EXPECT_LT(axis_about({5.0}).low, 5.0);
  EXPECT_GT(axis_about({}).high, axis_about({}).low);
}

TEST(ReportFigures, PlotPutsPointsWhereTheyBelong) {
  SvgPlot plot({0.0, 10.0}, {0.0, 1.0}, "x <m>", "y", 100, 100);
  plot.dots({{0.0, 0.0}, {10.0, 1.0}}, "#000", 1.0);
  plot.box(5.0, 1.0, {0.0, 0.2, 0.5, 0.7, 1.0}, "#111");
  plot.box(5.0, 1.0, {0.0, 0.2}, "#222");
  const std::string svg = plot.svg("a \"plot\"");
  // The axes leave 58 px at the left, 12 at the right, 10 above and 44 below.
  EXPECT_THAT(svg, HasSubstr("cx=\"58.0\" cy=\"56.0\""));
  EXPECT_THAT(svg, HasSubstr("cx=\"88.0\" cy=\"10.0\""));
  EXPECT_THAT(svg, HasSubstr("x &lt;m&gt;"));
  EXPECT_THAT(svg, HasSubstr("#111"));
  EXPECT_THAT(svg, Not(HasSubstr("#222")));
}

TEST(ReportFigures, HeatGrowsDarker) {
  EXPECT_EQ(heat_color(0.0), "#ebf3fa");
  EXPECT_EQ(heat_color(-1.0), heat_color(0.0));
  EXPECT_EQ(heat_color(2.0), heat_color(1.0));
  EXPECT_NE(heat_color(0.4), heat_color(0.6));
}

}  // namespace
}  // namespace lvcalib
