// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/residual_map_plot.h"

#include <gtest/gtest.h>

#include "model_example.h"

namespace lvcalib::widgets::residual_map_plot_test {
namespace {

std::shared_ptr<const ChannelView> view(Channel channel) {
  const auto& example = test::model_example();
  return std::make_shared<const ChannelView>(
      make_channel_view(*example.base, *example.base, channel));
}

TEST(ResidualMapPlotTest, ColoursCellsOfTheBoard) {
  ResidualMapPlot plot(ResidualMapPlot::Plane::kBoard);
  plot.resize(400, 300);
  plot.setView(view(Channel::kRange));
  ASSERT_GE(plot.plottableCount(), 1);
  EXPECT_NE(qobject_cast<QCPColorMap*>(plot.plottable(0)), nullptr);
  EXPECT_TRUE(plot.csv().startsWith("x,y,mean"));
  EXPECT_STREQ(plot.xName(), "board x");
}

TEST(ResidualMapPlotTest, DrawsArrowsForCorners) {
  ResidualMapPlot plot(ResidualMapPlot::Plane::kImage);
  plot.setView(view(Channel::kCorner));
  int arrows = 0;
  for (int k = 0; k < plot.itemCount(); ++k)
    arrows += qobject_cast<QCPItemLine*>(plot.item(k)) != nullptr ? 1 : 0;
  EXPECT_GT(arrows, 4);
}

TEST(ResidualMapPlotTest, SaysWhereThereIsNoMap) {
  ResidualMapPlot image(ResidualMapPlot::Plane::kImage);
  image.setView(view(Channel::kRange));
  ASSERT_EQ(image.itemCount(), 1);
  EXPECT_NE(qobject_cast<QCPItemText*>(image.item(0)), nullptr);
  ResidualMapPlot angles(ResidualMapPlot::Plane::kAngles);
  angles.setView(nullptr);
  EXPECT_EQ(angles.itemCount(), 1);
}

}  // namespace
}  // namespace lvcalib::widgets::residual_map_plot_test
