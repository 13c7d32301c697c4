// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/residual_plot.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "model_example.h"

namespace lvcalib::widgets::residual_plot_test {
namespace {

std::shared_ptr<const ResidualFigure> figure(const QString& covariate) {
  const auto& example = test::model_example();
  auto view = std::make_shared<const ChannelView>(
      make_channel_view(*example.base, *example.base, Channel::kRange));
  return make_residual_figure(view, covariate, nullptr, {});
}

TEST(ResidualPlotTest, DrawsMeansAndTellsThemAsCsv) {
  ResidualPlot plot;
  plot.resize(500, 300);
  plot.setFigure(figure("range"));
  EXPECT_GT(plot.itemCount(), 2) << "the cloud and the noise";
  EXPECT_GE(plot.plottableCount(), 3);
  const QByteArray csv = plot.csv();
  EXPECT_TRUE(csv.startsWith("range,mean,sigma,n,significant"));
  EXPECT_EQ(csv.count('\n'), static_cast<qsizetype>(plot.figure()->now.size()) + 1);
  const int with_before = plot.plottableCount();
  plot.setBeforeShown(false);
  EXPECT_LT(plot.plottableCount(), with_before);
}

// Which colour is what stands above the figure: of what is drawn, and in the colours it is drawn
// in.
TEST(ResidualPlotTest, EveryCurveStandsInTheLegend) {
  ResidualPlot plot;
  plot.resize(500, 400);
  auto whole = std::make_shared<ResidualFigure>(*figure("range"));
  plot.setFigure(whole);
  const auto legend_has = [&](const QColor& color) {
    const auto entries = plot.legendEntries();
    return std::any_of(entries.begin(), entries.end(),
                       [&](const LegendEntry& entry) { return entry.color == color; });
  };
  for (const QColor& color : {plot.colors().mark, plot.colors().refused, plot.colors().zero,
                              plot.colors().axis, ResidualFigure::dotColor()})
    EXPECT_TRUE(legend_has(color)) << color.name().toStdString();
  EXPECT_FALSE(legend_has(plot.colors().fit)) << "no effect is chosen";
  plot.setBeforeShown(false);
  EXPECT_FALSE(legend_has(plot.colors().axis));
  auto with_effect = std::make_shared<ResidualFigure>(*whole);
  with_effect->predicted = with_effect->now;
  plot.setFigure(with_effect);
  EXPECT_TRUE(legend_has(plot.colors().fit));
  plot.setSelected({0, 1});
  EXPECT_TRUE(legend_has(plot.colors().emphasis));
  plot.setFigure(nullptr, "nothing");
  EXPECT_TRUE(plot.legendEntries().empty());
}

TEST(ResidualPlotTest, SaysWhyItIsEmpty) {
  ResidualPlot plot;
  plot.setFigure(nullptr, "no model yet");
  ASSERT_EQ(plot.itemCount(), 1);
  auto* text = qobject_cast<QCPItemText*>(plot.item(0));
  ASSERT_NE(text, nullptr);
  EXPECT_EQ(text->text(), "no model yet");
  EXPECT_TRUE(plot.csv().isEmpty());
}

TEST(ResidualPlotTest, NothingOfAFigureStaysWithoutIt) {
  ResidualPlot plot;
  plot.setFigure(figure("range"));
  EXPECT_FALSE(plot.xAxis->label().isEmpty() || plot.yAxis->label().isEmpty());
  plot.setFigure(nullptr, "its pattern is being drawn");
  EXPECT_TRUE(plot.xAxis->label().isEmpty() && plot.yAxis->label().isEmpty());
}

TEST(ResidualPlotTest, BrushingGivesTheAreaInAxisUnits) {
  ResidualPlot plot;
  plot.resize(500, 300);
  plot.setFigure(figure("range"));
  plot.show();
  plot.replot();
  // The rectangle has a picture of its own only while there may be one.
  EXPECT_EQ(plot.layer("overlay")->mode(), QCPLayer::lmLogical);
  plot.setBrushing(true);
  EXPECT_EQ(plot.layer("overlay")->mode(), QCPLayer::lmBuffered);
  QSignalSpy brushed(&plot, &ResidualPlot::brushed);
  const QPoint from(static_cast<int>(plot.xAxis->coordToPixel(2.0)),
                    static_cast<int>(plot.yAxis->coordToPixel(10.0)));
  const QPoint to(static_cast<int>(plot.xAxis->coordToPixel(3.0)),
                  static_cast<int>(plot.yAxis->coordToPixel(-10.0)));
  QTest::mousePress(&plot, Qt::LeftButton, {}, from);
  QTest::mouseMove(&plot, (from + to) / 2);
  QTest::mouseMove(&plot, to);
  QTest::mouseRelease(&plot, Qt::LeftButton, {}, to);
  ASSERT_GE(brushed.count(), 1);
  const QRectF area = brushed.last().at(0).toRectF();
  EXPECT_NEAR(area.left(), 2.0, 0.05);
  EXPECT_NEAR(area.right(), 3.0, 0.05);
  EXPECT_NEAR(area.top(), -10.0, 0.8);
  EXPECT_NEAR(area.bottom(), 10.0, 0.8);
}

// A few residuals lie beyond what is drawn: they are of the stretch that is brushed from edge to
// edge.
TEST(ResidualPlotTest, BrushingFromEdgeToEdgeTakesWhatLiesBeyond) {
  ResidualPlot plot;
  plot.resize(500, 300);
  plot.setFigure(figure("range"));
  plot.show();
  plot.replot();
  plot.setBrushing(true);
  QSignalSpy brushed(&plot, &ResidualPlot::brushed);
  const QRect drawn = plot.axisRect()->rect();
  const auto brush = [&](const QPoint& from, const QPoint& to) {
    QTest::mousePress(&plot, Qt::LeftButton, {}, from);
    QTest::mouseMove(&plot, (from + to) / 2);
    QTest::mouseMove(&plot, to);
    QTest::mouseRelease(&plot, Qt::LeftButton, {}, to);
    return brushed.last().at(0).toRectF();
  };
  const int x = drawn.center().x();
  const QRectF all = brush({x, drawn.top() + 1}, {x + 20, drawn.bottom() + 5});
  EXPECT_LT(all.top(), -1e9);
  EXPECT_LT(all.bottom(), 1e3) << "the upper edge was not reached";
  const QRectF up = brush({x, drawn.center().y()}, {x + 20, drawn.top() - 5});
  EXPECT_GT(up.bottom(), 1e9);
  // Of a part that is looked at closely the rest is out of sight, and not meant.
  plot.yAxis->setRange(-1.0, 1.0);
  plot.replot();
  EXPECT_LT(brush({x, drawn.center().y()}, {x + 20, drawn.top() - 5}).bottom(), 1e3);
}

TEST(ResidualPlotTest, SelectedResidualsAreDrawnAndForgottenWithTheirFigure) {
  ResidualPlot plot;
  plot.setFigure(figure("range"));
  const int before = plot.graphCount();
  plot.setSelected({1, 2, 3});
  EXPECT_EQ(plot.graphCount(), before + 1);
  EXPECT_EQ(plot.graph(before)->dataCount(), 3);
  plot.setFigure(figure("range"));
  EXPECT_EQ(plot.graphCount(), before) << "other residuals";
}

}  // namespace
}  // namespace lvcalib::widgets::residual_plot_test
