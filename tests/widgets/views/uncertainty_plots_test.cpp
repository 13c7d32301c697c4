// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/uncertainty_plots.h"

#include <cmath>

#include <gtest/gtest.h>

#include "widgets/views/plots_test.h"

namespace lvcalib::widgets::uncertainty_plots_test {
namespace {

// Three by two cells that grow to the right; one is behind the camera.
ProjectedUncertainty example() {
  ProjectedUncertainty map;
  map.columns = 3;
  map.rows = 2;
  map.range_m = 5.0;
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 3; ++column) {
      map.pixel.emplace_back(100.0 + 200.0 * column, 100.0 + 200.0 * row);
      map.sigma_px.push_back(row == 1 && column == 0 ? std::nan("") : 0.25 * (column + 1));
    }
  }
  return map;
}

TEST(UncertaintyMapPlot, ShowsEveryCellInTheColourOfItsValue) {
  UncertaintyMapPlot plot(UncertaintyMapPlot::Of::kExtrinsic);
  plot.resize(500, 340);
  plot.setMap(example(), {600, 400});
  const auto rows = test::rows_of(plot.csv());
  ASSERT_EQ(rows.size(), 6);
  EXPECT_EQ(rows[2], "500,100,0.75");
  const QImage picture = plot.toPixmap(500, 340).toImage();
  const auto at = [&](double u, double v) {
    return picture.pixelColor(static_cast<int>(plot.xAxis->coordToPixel(u)),
                              static_cast<int>(plot.yAxis->coordToPixel(v)));
  };
  EXPECT_GT(at(480, 120).lightness(), at(120, 120).lightness() + 20);
  EXPECT_EQ(at(130, 330), plot.colors().background);  // no ray there
}

// As the core computes it: outer cells are centred on the outermost pixels.
TEST(UncertaintyMapPlot, NoCellReachesBeyondTheImage) {
  UncertaintyMapPlot plot(UncertaintyMapPlot::Of::kExtrinsic);
  plot.resize(500, 340);
  ProjectedUncertainty map = example();
  for (Eigen::Vector2d& pixel : map.pixel)
    pixel = {(pixel.x() - 100.0) * 599.0 / 400.0, (pixel.y() - 100.0) * 399.0 / 200.0};
  plot.setMap(map, {600, 400});
  plot.toPixmap(500, 340);  // Fits the image once its place is known.
  plot.xAxis->setRange(-200, 800);
  plot.yAxis->setRange(-150, 550);
  const QImage picture = plot.toPixmap(500, 340).toImage();
  const auto at = [&](double u, double v) {
    return picture.pixelColor(static_cast<int>(plot.xAxis->coordToPixel(u)),
                              static_cast<int>(plot.yAxis->coordToPixel(v)));
  };
  for (const double v : {40.0, 360.0}) {
    EXPECT_NE(at(580, v), plot.colors().background);
    EXPECT_EQ(at(640, v), plot.colors().background) << v;
  }
  EXPECT_EQ(at(430, -50), plot.colors().background);
  EXPECT_EQ(at(430, 450), plot.colors().background);
}

TEST(UncertaintyMapPlot, ImageStandsUprightWithSquarePixels) {
  UncertaintyMapPlot plot(UncertaintyMapPlot::Of::kExtrinsic);
  plot.resize(500, 340);
  plot.setMap(example(), {600, 400});
  plot.toPixmap(500, 340);
  EXPECT_LT(plot.yAxis->coordToPixel(0), plot.yAxis->coordToPixel(400));
  EXPECT_NEAR(plot.xAxis->coordToPixel(100) - plot.xAxis->coordToPixel(0),
              plot.yAxis->coordToPixel(100) - plot.yAxis->coordToPixel(0), 1.0);
}

TEST(UncertaintyMapPlot, NothingIsSaidToBeNothing) {
  UncertaintyMapPlot plot(UncertaintyMapPlot::Of::kExtrinsic);
  plot.setMap(std::nullopt, {});
  EXPECT_TRUE(plot.csv().isEmpty());
  ProjectedUncertainty blind = example();
  for (double& sigma : blind.sigma_px) sigma = std::nan("");
  plot.setMap(blind, {600, 400});
  EXPECT_TRUE(plot.csv().isEmpty());
}

TEST(UncertaintyRangePlot, ShowsBothCurvesOverTheirRange) {
  UncertaintyRangePlot plot;
  plot.resize(400, 300);
  plot.setRanges({{2.0, 0.5, 0.2}, {10.0, 1.5, 0.3}, {50.0, 7.0, 0.9}}, {});
  const auto rows = test::rows_of(plot.csv());
  ASSERT_EQ(rows.size(), 3);
  EXPECT_EQ(rows[1], "10,1.5,0.3");
  EXPECT_TRUE(plot.xAxis->range().contains(2.0) && plot.xAxis->range().contains(50.0));
  EXPECT_TRUE(plot.yAxis->range().contains(0.2) && plot.yAxis->range().contains(7.0));
  EXPECT_TRUE(test::shows(plot, plot.colors().series(0)));
  EXPECT_TRUE(test::shows(plot, plot.colors().series(1)));
  plot.setRanges({}, {});
  EXPECT_TRUE(plot.csv().isEmpty());
}

TEST(UncertaintyRangePlot, TheTotalIsDrawnBesideItsNoise) {
  UncertaintyRangePlot plot;
  plot.resize(400, 300);
  plot.setRanges({{2.0, 0.5, 0.2}, {10.0, 1.5, 0.3}}, {{2.0, 2.5, 1.2}, {10.0, 9.5, 1.3}});
  EXPECT_TRUE(plot.csv().startsWith("range_m,across_mm,along_mm,across_total_mm,along_total_mm"));
  EXPECT_EQ(test::rows_of(plot.csv())[1], "10,1.5,0.3,9.5,1.3");
  EXPECT_TRUE(plot.yAxis->range().contains(0.2) && plot.yAxis->range().contains(9.5));
  ASSERT_EQ(plot.graphCount(), 4);
  int dashed = 0;
  for (int k = 0; k < 4; ++k) dashed += plot.graph(k)->pen().style() == Qt::DashLine ? 1 : 0;
  EXPECT_EQ(dashed, 2);
}

}  // namespace
}  // namespace lvcalib::widgets::uncertainty_plots_test
