// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/response_plots.h"

#include <cmath>

#include <gtest/gtest.h>

#include "widgets/views/plots_test.h"
#include "widgets/views/response_example.h"
#include "words/core_text.h"

namespace lvcalib::widgets::response_plots_test {
namespace {

TEST(ResponseScope, ThinsEvenlyAndLeavesRefusedCirclesOut) {
  const SceneResponse scene = test::response_scene("A", 900);
  ResponseScope scope;
  scope.scenes = {&scene};
  EXPECT_EQ(scope.samples(false, 10'000).size(), 900U);
  const auto overlap = scope.samples(true, 10'000);
  EXPECT_LT(overlap.size(), 900U);
  for (const BoundarySample* s : overlap) EXPECT_TRUE(s->overlap);
  const auto some = scope.samples(false, 90);
  ASSERT_EQ(some.size(), 90U);
  EXPECT_EQ(some[1] - some[0], 10);
  SceneResponse refused = scene;
  refused.nodes[0].state = NodeResponseState::kClipped;
  scope.scenes = {&refused};
  EXPECT_TRUE(scope.samples(false, 10'000).empty());
}

TEST(TransitionPlot, ShowsMeansAndTheFitOfOneSceneInItsIntensities) {
  const SceneResponse scene = test::response_scene("A", 4000);
  TransitionPlot plot;
  plot.resize(420, 320);
  plot.setScope(test::scope_of({&scene}));
  plot.show();
  EXPECT_TRUE(test::shows(plot, plot.colors().fit));
  EXPECT_TRUE(test::shows(plot, plot.colors().mark));  // The means.
  const auto rows = test::rows_of(plot.csv());
  ASSERT_GT(rows.size(), 20);
  // Far outside the means are the white level, far inside the black one.
  EXPECT_NEAR(rows.front().split(',')[2].toDouble(), test::kBlack, 3.0);
  EXPECT_NEAR(rows.back().split(',')[2].toDouble(), test::kWhite, 3.0);
  EXPECT_GT(plot.yAxis->range().upper, test::kWhite);
  EXPECT_LT(plot.xAxis->range().lower, -19.0);
}

TEST(TransitionPlot, ScenesTogetherGoFromZeroToOne) {
  const SceneResponse a = test::response_scene("A", 2000);
  const SceneResponse b = test::response_scene("B", 2000);
  TransitionPlot plot;
  plot.resize(420, 320);
  plot.setScope(test::scope_of({&a, &b}));
  plot.show();
  EXPECT_TRUE(test::shows(plot, plot.colors().fit));
  EXPECT_LT(plot.yAxis->range().upper, 2.0);
  EXPECT_TRUE(plot.csv().contains("\nA,"));
  EXPECT_TRUE(plot.csv().contains("\nB,"));
}

TEST(AnglePlot, DegreesAreEquallyLongAndTheEllipseIsInSight) {
  const SceneResponse scene = test::response_scene("A", 2000);
  AnglePlot plot;
  plot.resize(500, 300);
  plot.setScope(test::scope_of({&scene}));
  plot.show();
  EXPECT_TRUE(test::shows(plot, plot.colors().fit));
  const double per_degree_x = plot.axisRect()->width() / plot.xAxis->range().size();
  const double per_degree_y = plot.axisRect()->height() / plot.yAxis->range().size();
  EXPECT_NEAR(per_degree_x / per_degree_y, 1.0, 1e-3);
  EXPECT_GT(plot.yAxis->range().upper, 2.0 * test::kPitchSigmaDeg);
  EXPECT_EQ(test::rows_of(plot.csv()).size(),
            static_cast<qsizetype>(test::scope_of({&scene}).samples(true, 1'000'000).size()));
}

TEST(RangePlot, BarsHoldEveryOverlapSample) {
  const SceneResponse scene = test::response_scene("A", 3000);
  RangePlot plot;
  plot.resize(420, 300);
  const ResponseScope scope = test::scope_of({&scene});
  plot.setScope(scope);
  plot.show();
  EXPECT_TRUE(test::shows(plot, plot.colors().fill));
  EXPECT_TRUE(test::shows(plot, plot.colors().fit));  // The lines at ±σ.
  int n = 0;
  for (const QByteArray& row : test::rows_of(plot.csv())) n += row.split(',')[2].toInt();
  EXPECT_EQ(n, static_cast<int>(scope.samples(true, 1'000'000).size()));
}

template <class Plot>
class EveryResponsePlot : public ::testing::Test {};
using Plots = ::testing::Types<TransitionPlot, AnglePlot, RangePlot>;
TYPED_TEST_SUITE(EveryResponsePlot, Plots);

TYPED_TEST(EveryResponsePlot, SaysWhyThereIsNothing) {
  TypeParam plot;
  plot.resize(360, 260);
  ResponseScope scope;
  scope.reason = Message("not enough samples: 12 of 200");
  plot.setScope(scope);
  plot.show();
  bool said = false;
  for (int k = 0; k < plot.itemCount(); ++k) {
    const auto* item = qobject_cast<QCPItemText*>(plot.item(k));
    said = said || (item != nullptr && item->text() == core_text(scope.reason));
  }
  EXPECT_TRUE(said);
  EXPECT_TRUE(plot.csv().isEmpty());
  plot.setPalette(test::palette_of(true));  // Rebuilds without harm.
  EXPECT_FALSE(test::shows(plot, plot.colors().fit));
}

}  // namespace
}  // namespace lvcalib::widgets::response_plots_test
