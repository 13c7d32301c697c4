// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/colors_pane.h"

#include <QLabel>
#include <QTest>
#include <QToolButton>

#include <gtest/gtest.h>

#include "views/cloud_view.h"
#include "widgets/support/calibrated_demo.h"

namespace lvcalib::widgets::colors_pane_test {
namespace {

// Of a line about the board and what lies around it only the board's points can be left out.
TEST(ColorsPaneTest, BrushedPointsAreLeftOutOfTheSceneShown) {
  const test::CalibratedDemo& demo = test::calibrated_demo();
  ColorsPane pane;
  pane.resize(700, 500);
  pane.show();
  pane.setResult(demo.result);
  pane.setSceneData(1, demo.clouds[1], demo.images[1]);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return !pane.busy() && pane.view()->scene() && pane.view()->scene()->size() > 0; },
      20'000));
  const SceneResult& scene = demo.result->scenes[1];
  const Cloud& cloud = *demo.clouds[1];
  std::vector<std::uint32_t> about, beside;
  for (std::uint32_t i = 0; i < cloud.size() && (about.size() < 3 || beside.size() < 2); ++i) {
    const auto& board = scene.board_points.points_m;
    const bool in = std::find(board.begin(), board.end(), cloud.points_m[i]) != board.end();
    (in ? about : beside).push_back(i);
  }
  ASSERT_GE(about.size(), 3U);
  auto* exclude = pane.findChild<QToolButton*>("colors-exclude");
  auto* text = pane.findChild<QLabel*>("colors-selection");
  PointsOfScenes wanted;
  QObject::connect(&pane, &ColorsPane::excludeWanted, &pane,
                   [&](const PointsOfScenes& points) { wanted = points; });
  Q_EMIT pane.view()->pointsBrushed({beside[0], beside[1]}, false);
  EXPECT_FALSE(exclude->isVisible());
  EXPECT_EQ(text->text(), "none about a board");
  Q_EMIT pane.view()->pointsBrushed({about[0], about[1], about[2]}, true);
  ASSERT_TRUE(exclude->isVisible());
  EXPECT_EQ(text->text(), "3 points");
  exclude->click();
  ASSERT_EQ(wanted.size(), 1U);
  EXPECT_EQ(wanted.begin()->first.toStdString(), scene.name);
  EXPECT_EQ(wanted.begin()->second.size(), 3U);
  pane.setResult(demo.result);  // The next one: its points may be others.
  EXPECT_FALSE(exclude->isVisible());
}

}  // namespace
}  // namespace lvcalib::widgets::colors_pane_test
