// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/sample_map_plot.h"

#include <gtest/gtest.h>

#include "widgets/views/plots_test.h"
#include "widgets/views/response_example.h"
#include "words/core_text.h"

namespace lvcalib::widgets::sample_map_plot_test {
namespace {

int refused_circles(const SampleMapPlot& plot) {
  int out = 0;
  for (int k = 0; k < plot.itemCount(); ++k) {
    const auto* circle = qobject_cast<QCPItemEllipse*>(plot.item(k));
    out += circle != nullptr && circle->pen().color() == plot.colors().refused ? 1 : 0;
  }
  return out;
}

TEST(SampleMapPlot, ShowsTheSamplesOnTheBoardInMillimetres) {
  const SceneResponse scene = test::response_scene("A", 2000);
  SampleMapPlot plot;
  plot.resize(400, 400);
  plot.setTarget(Target());
  plot.setScope(test::scope_of({&scene}));
  plot.show();
  EXPECT_TRUE(test::shows(plot, plot.colors().emphasis));  // The overlap region.
  const auto rows = test::rows_of(plot.csv());
  ASSERT_EQ(rows.size(), 2000);
  for (const QByteArray& row : rows) {
    const auto cells = row.split(',');
    EXPECT_NEAR(std::hypot(cells[0].toDouble(), cells[1].toDouble()), 60.0 + cells[2].toDouble(),
                1e-3);
  }
  EXPECT_EQ(refused_circles(plot), 0);
}

TEST(SampleMapPlot, MarksCirclesThatAreLeftOut) {
  SceneResponse scene = test::response_scene("A", 500);
  Target target;
  ASSERT_FALSE(target.nodes().empty());
  NodeResponse refused;
  refused.id = target.nodes().front().id;
  refused.state = NodeResponseState::kClipped;
  scene.nodes[0].id = target.nodes().back().id;
  scene.nodes.push_back(refused);
  SampleMapPlot plot;
  plot.setTarget(target);
  plot.setScope(test::scope_of({&scene}));
  EXPECT_EQ(refused_circles(plot), 1);
}

TEST(SampleMapPlot, WithoutSamplesItSaysWhy) {
  SampleMapPlot plot;
  ResponseScope scope;
  scope.reason = Message("this board has no circles");
  plot.setScope(scope);
  EXPECT_TRUE(plot.csv().isEmpty());
  const auto* text = qobject_cast<QCPItemText*>(plot.item(plot.itemCount() - 1));
  ASSERT_NE(text, nullptr);
  EXPECT_EQ(text->text(), core_text(scope.reason));
}

}  // namespace
}  // namespace lvcalib::widgets::sample_map_plot_test
