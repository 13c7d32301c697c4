// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/board_map_plot.h"

#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

#include "widgets/views/plots_test.h"

namespace lvcalib::widgets::board_map_plot_test {
namespace {

std::vector<CenterPath> example(const Target& target) {
  std::vector<CenterPath> paths;
  for (const TargetNode& node : target.nodes()) {
    CenterPath path;
    path.id = node.id;
    path.valid = node.id != 8;
    path.board_m = node.center_m;
    for (int k = 0; k < 5; ++k) {
      path.predicted_m.emplace_back(0.004 / (1 << k), -0.002 / (1 << k));
      path.measured_m.emplace_back(1e-4, 1e-4);
    }
    path.final_m = {2e-4, -1e-4};
    path.covariance_m2 = Eigen::Vector2d(4e-8, 1e-8).asDiagonal();
    paths.push_back(path);
  }
  return paths;
}

TEST(BoardMapPlot, EnlargesPathsToAReadableSize) {
  BoardMapPlot plot;
  const Target target;
  plot.setTarget(target);
  plot.setPaths(example(target));
  // 4.5 mm times 10 is within 0.4 × 220 mm, times 20 is not.
  EXPECT_EQ(plot.enlargement(), 10.0);
  plot.resize(420, 420);
  EXPECT_TRUE(test::shows(plot, plot.colors().series(0)));
  EXPECT_TRUE(test::shows(plot, plot.colors().refused));  // Node 8.
  EXPECT_EQ(test::rows_of(plot.csv()).size(), 9 * 11);
}

TEST(BoardMapPlot, AClickNamesTheNode) {
  BoardMapPlot plot;
  const Target target;
  plot.resize(420, 420);
  plot.setTarget(target);
  plot.show();
  QSignalSpy clicked(&plot, &BoardMapPlot::nodeClicked);
  const Eigen::Vector2d c = 1e3 * target.nodes()[5].center_m;
  const QPoint place(static_cast<int>(plot.xAxis->coordToPixel(c.x())),
                     static_cast<int>(plot.yAxis->coordToPixel(c.y())));
  QTest::mouseClick(&plot, Qt::LeftButton, {}, place);
  ASSERT_EQ(clicked.size(), 1);
  EXPECT_EQ(clicked[0][0].toInt(), 5);
}

TEST(BoardMapPlot, CirclesStayRound) {
  BoardMapPlot plot;
  plot.setTarget(Target());
  plot.resize(700, 300);
  plot.show();
  const double x = plot.xAxis->coordToPixel(100) - plot.xAxis->coordToPixel(0);
  const double y = plot.yAxis->coordToPixel(0) - plot.yAxis->coordToPixel(100);
  EXPECT_NEAR(x / y, 1.0, 0.02);
}

}  // namespace
}  // namespace lvcalib::widgets::board_map_plot_test
