// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/world_pane.h"

#include <QComboBox>
#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

#include "pages/scene_overlay.h"
#include "views/cloud_view.h"
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
  EXPECT_EQ(scene.whole.low, 1.0);
  EXPECT_EQ(scene.whole.high, 3.0);
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

TEST_F(WorldPaneTest, AClickOnABoardGoesToItsScene) {
  pane_.setResult(demo_.result);
  ASSERT_TRUE(settle());
  QSignalSpy activated(&pane_, &WorldPane::sceneActivated);
  const auto first = static_cast<std::uint32_t>(demo_.result->scenes[0].board_points.size());
  Q_EMIT pane_.view()->pointPicked(first);
  ASSERT_EQ(activated.count(), 1);
  EXPECT_EQ(activated[0][0].toInt(), 1);
}

TEST_F(WorldPaneTest, WithoutAResultItSaysWhatToDo) {
  ASSERT_TRUE(settle());
  EXPECT_TRUE(pane_.view()->scene()->notice.contains("run the calibration first"));
}

}  // namespace
}  // namespace lvcalib::widgets::world_pane_test
