// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/world_pane.h"

#include <QComboBox>
#include <QLabel>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>

#include <gtest/gtest.h>

#include "pages/scene_overlay.h"
#include "style/swatch.h"
#include "views/cloud_view.h"
#include "views/color_bar.h"
#include "widgets/support/calibrated_demo.h"

namespace lvcalib::widgets::world_pane_test {
namespace {

class WorldPaneTest : public ::testing::Test {
 protected:
  void SetUp() override {
    pane_.resize(700, 500);
    pane_.show();
  }
  bool settle() {
    return QTest::qWaitFor([&] { return !pane_.busy() && pane_.view()->scene(); }, 20'000);
  }
  const test::CalibratedDemo& demo_ = test::calibrated_demo();
  WorldPane pane_;
};

TEST_F(WorldPaneTest, HoldsEveryBoardAndBothSensors) {
  pane_.setResult(demo_.result);
  ASSERT_TRUE(settle());
  std::size_t points = 0;
  for (const SceneResult& scene : demo_.result->scenes) points += scene.board_points.size();
  const CloudScene& scene = *pane_.view()->scene();
  EXPECT_EQ(scene.size(), points);
  const auto camera = camera_pyramid(*demo_.result);
  ASSERT_EQ(camera.size(), 5U);
  for (const Eigen::Vector3d& p : camera) {
    EXPECT_TRUE((p.array() >= scene.low_m.array() - 1e-6).all());
    EXPECT_TRUE((p.array() <= scene.high_m.array() + 1e-6).all());
  }
  EXPECT_LE(scene.low_m.x(), 0.0);  // The LiDAR.
  // What the camera sees lies inside its pyramid: its rays go through the image's corners.
  const Rigid3& camera_from_lidar = demo_.result->extrinsic.camera_from_lidar.transform;
  const auto pixel = demo_.result->camera.project(camera_from_lidar * camera[3]);
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), demo_.result->camera.width_px - 0.5, 0.01);
}

// Single points far away do not count when a cloud is opened; here all boards do.
TEST_F(WorldPaneTest, OpensOnABoardFarBehindTheOthers) {
  auto result = std::make_shared<CalibrationResult>(*demo_.result);
  std::vector<Eigen::Vector3f>& far = result->scenes[0].board_points.points_m;
  far.resize(far.size() / 50);  // As few as its returns would be there.
  for (Eigen::Vector3f& p : far) p *= 20.0F;
  pane_.setResult(result);
  ASSERT_TRUE(settle());
  const CloudScene& scene = *pane_.view()->scene();
  EXPECT_GT(scene.high_m.norm(), 20.0);
  EXPECT_EQ(scene.most_low_m, scene.low_m);
  EXPECT_EQ(scene.most_high_m, scene.high_m);
}

// Scenes have names, not an order: a colour of its own for each, and a legend that says which.
TEST_F(WorldPaneTest, EverySceneHasItsColourAndItsName) {
  pane_.setResult(demo_.result);
  ASSERT_TRUE(settle());
  const CloudScene& scene = *pane_.view()->scene();
  EXPECT_FALSE(scene.has_scale);
  ASSERT_EQ(scene.categories.size(), demo_.result->scenes.size());
  for (std::size_t k = 0; k < scene.categories.size(); ++k) {
    EXPECT_EQ(scene.categories[k].name.toStdString(), demo_.result->scenes[k].name);
    for (std::size_t other = 0; other < k; ++other)
      EXPECT_NE(scene.categories[k].color, scene.categories[other].color);
  }
  for (std::size_t k = 0; k < scene.size(); ++k) {
    const QRgb wanted = scene.categories[scene.cloud->line[scene.order[k]] - 1U].color;
    ASSERT_EQ(qRgb(scene.rgb[3 * k], scene.rgb[3 * k + 1], scene.rgb[3 * k + 2]), wanted);
  }
  const ColorBar& legend = *pane_.view()->legend();
  for (const CloudCategory& category : scene.categories)
    EXPECT_TRUE(legend.toolTip().contains(swatch_html(category.color, legend.palette())));
}

TEST_F(WorldPaneTest, AClickOnABoardGoesToItsScene) {
  pane_.setResult(demo_.result);
  ASSERT_TRUE(settle());
  QSignalSpy activated(&pane_, &WorldPane::sceneActivated);
  const auto first = static_cast<std::uint32_t>(demo_.result->scenes[0].board_points.size());
  Q_EMIT pane_.view()->pointPicked(first);
  ASSERT_EQ(activated.count(), 1);
  EXPECT_EQ(activated[0][0].toInt(), 1);
}

// The brush selects points of several scenes at once; each goes to its own.
TEST_F(WorldPaneTest, BrushedPointsAreLeftOutOfTheirScenes) {
  pane_.setResult(demo_.result);
  ASSERT_TRUE(settle());
  auto* exclude = pane_.findChild<QToolButton*>("world-exclude");
  EXPECT_FALSE(exclude->isVisible());
  const auto first = static_cast<std::uint32_t>(demo_.result->scenes[0].board_points.size());
  Q_EMIT pane_.view()->pointsBrushed({3, first + 5}, false);
  Q_EMIT pane_.view()->pointsBrushed({first + 5, first + 9}, true);
  ASSERT_TRUE(exclude->isVisible());
  EXPECT_EQ(pane_.findChild<QLabel*>("world-selection")->text(), "3 points");
  PointsOfScenes wanted;
  QObject::connect(&pane_, &WorldPane::excludeWanted, &pane_,
                   [&](const PointsOfScenes& points) { wanted = points; });
  exclude->click();
  ASSERT_EQ(wanted.size(), 2U);
  const auto& scenes = demo_.result->scenes;
  EXPECT_EQ(wanted[QString::fromStdString(scenes[0].name)],
            std::vector<Eigen::Vector3f>{scenes[0].board_points.points_m[3]});
  EXPECT_EQ(wanted[QString::fromStdString(scenes[1].name)],
            (std::vector<Eigen::Vector3f>{scenes[1].board_points.points_m[5],
                                          scenes[1].board_points.points_m[9]}));
  // Places in one result's boards mean nothing in another's.
  pane_.setResult(demo_.result);
  EXPECT_FALSE(exclude->isVisible());
}

TEST_F(WorldPaneTest, WithoutAResultItSaysWhatToDo) {
  ASSERT_TRUE(settle());
  EXPECT_TRUE(pane_.view()->scene()->notice.contains("run the calibration first"));
}

}  // namespace
}  // namespace lvcalib::widgets::world_pane_test
