// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/extrinsic_page.h"

#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTabWidget>
#include <QTest>
#include <QTextBrowser>
#include <algorithm>

#include <gtest/gtest.h>

#include "pages/colors_pane.h"
#include "views/category_plots.h"
#include "views/cloud_view.h"
#include "widgets/support/calibrated_demo.h"

namespace lvcalib::widgets::extrinsic_page_test {
namespace {

class ExtrinsicPageTest : public ::testing::Test {
 protected:
  void SetUp() override {
    page_.resize(1280, 760);
    page_.show();
  }
  [[nodiscard]] QByteArray csv(const QString& tip_start) const {
    for (const CategoryPlot* plot : page_.findChildren<CategoryPlot*>()) {
      if (plot->toolTip().startsWith(tip_start)) return plot->csv();
    }
    return {};
  }
  const test::CalibratedDemo& demo_ = test::calibrated_demo();
  ExtrinsicPage page_;
};

TEST_F(ExtrinsicPageTest, PlotsCarryTheResultsNumbers) {
  page_.setResult(demo_.result);
  const auto& solution = demo_.result->extrinsic;
  const QByteArray px = csv("Root mean square of the tag corners");
  for (const SceneSolution& s : solution.scenes) {
    EXPECT_TRUE(
        px.contains(QByteArray::fromStdString(s.name) + "," + csv_number(s.rms_px).toUtf8() + ",1"))
        << px.toStdString();
  }
  const QByteArray moved = csv("How far the LiDAR's origin moves");
  ASSERT_EQ(solution.leave_one_out.size(), 3U);
  for (const LeaveOneOut& l : solution.leave_one_out) {
    EXPECT_TRUE(moved.contains(csv_number(l.translation_mm).toUtf8()));
  }
  // One row per used corner of 16 tags in 3 scenes, or fewer where a tag was refused.
  EXPECT_GT(csv("Lengths of the corner").count('\n'), 100);
  EXPECT_TRUE(page_.findChild<QTextBrowser*>("pose")->toPlainText().contains("T_camera_lidar"));
}

TEST_F(ExtrinsicPageTest, AClickGoesToTheScene) {
  page_.setResult(demo_.result);
  QSignalSpy activated(&page_, &ExtrinsicPage::sceneActivated);
  auto* plot = page_.findChildren<BarPlot*>().front();
  QTest::qWait(50);
  QTest::mouseClick(plot, Qt::LeftButton, {},
                    QPoint(static_cast<int>(plot->xAxis->coordToPixel(2)), plot->height() / 2));
  ASSERT_EQ(activated.size(), 1);
  EXPECT_EQ(activated[0][0].toInt(), 1);
}

TEST_F(ExtrinsicPageTest, ALineOverTheBarsAsksWhatTheResultIsWithoutTheScenesAboveIt) {
  page_.setResult(demo_.result);
  QSignalSpy wanted(&page_, &ExtrinsicPage::scenesPreviewWanted);
  QSignalSpy dropped(&page_, &ExtrinsicPage::scenesPreviewDropped);
  QSignalSpy rejected(&page_, &ExtrinsicPage::rejectWanted);
  auto* bars = page_.findChildren<BarPlot*>().front();
  auto* label = page_.findChild<QLabel*>("without-scenes");
  auto* reject = page_.findChild<QPushButton*>("reject-beyond");
  EXPECT_FALSE(reject->isEnabled());
  EXPECT_TRUE(label->text().contains("dashed line"));
  const auto& scenes = demo_.result->extrinsic.scenes;
  const auto worst = std::max_element(
      scenes.begin(), scenes.end(),
      [](const SceneSolution& a, const SceneSolution& b) { return a.rms_px < b.rms_px; });
  const QString name = QString::fromStdString(worst->name);
  while (bars->beyond().empty()) QTest::keyClick(bars, Qt::Key_Down);
  ASSERT_FALSE(wanted.isEmpty());
  EXPECT_EQ(wanted.last()[0].toStringList(), QStringList{name});
  EXPECT_TRUE(label->text().contains("Solving without " + name));
  CalibrationResult other = *demo_.result;
  other.extrinsic.camera_from_lidar.transform.translation.x() += 4e-4;
  page_.setScenesPreview(*demo_.result, other);
  EXPECT_TRUE(label->text().contains("Without " + name + ":")) << label->text().toStdString();
  EXPECT_TRUE(label->text().contains("move by 0.400 mm"));
  QTest::mouseClick(reject, Qt::LeftButton);
  ASSERT_EQ(rejected.count(), 1);
  EXPECT_EQ(rejected[0][0].toStringList(), QStringList{name});
  dropped.clear();
  QTest::mouseClick(page_.findChild<QPushButton*>("drop-threshold"), Qt::LeftButton);
  EXPECT_EQ(dropped.count(), 1);
  EXPECT_FALSE(bars->threshold().has_value());
  EXPECT_FALSE(reject->isEnabled());
}

// Below all bars nothing would be left to solve, which is said in words, and no click leads there.
TEST_F(ExtrinsicPageTest, ALineBelowAllBarsLeavesNoScene) {
  page_.setResult(demo_.result);
  QSignalSpy wanted(&page_, &ExtrinsicPage::scenesPreviewWanted);
  auto* bars = page_.findChildren<BarPlot*>().front();
  auto* label = page_.findChild<QLabel*>("without-scenes");
  auto* reject = page_.findChild<QPushButton*>("reject-beyond");
  while (bars->beyond().size() + 1 < demo_.result->scenes.size())
    QTest::keyClick(bars, Qt::Key_Down);
  EXPECT_TRUE(reject->isEnabled()) << "one is left";
  // What the solve says of those that are left, without where they lie.
  page_.setScenesError(Error::input(Message("needs more scenes"), "/data/rig"));
  EXPECT_FALSE(reject->isEnabled());
  EXPECT_TRUE(label->text().contains("needs more scenes"));
  EXPECT_FALSE(label->text().contains("/data/rig")) << label->text().toStdString();
  while (bars->beyond().size() < demo_.result->scenes.size()) QTest::keyClick(bars, Qt::Key_Down);
  EXPECT_TRUE(label->text().contains("no scene would be left")) << label->text().toStdString();
  EXPECT_FALSE(reject->isEnabled());
  for (const QList<QVariant>& asked : wanted)
    EXPECT_LT(asked[0].toStringList().size(), static_cast<qsizetype>(demo_.result->scenes.size()));
  while (bars->beyond().size() == demo_.result->scenes.size()) QTest::keyClick(bars, Qt::Key_Up);
  EXPECT_TRUE(reject->isEnabled());
}

TEST_F(ExtrinsicPageTest, WhatTheSolveRefusedStandsBesideItsBox) {
  auto changed = std::make_shared<CalibrationResult>(*demo_.result);
  NodeResidual& node = changed->extrinsic.scenes[1].nodes[2];
  node.used = false;
  node.residual_m = Eigen::Vector3d(0.0125, 0.0, 0.0);
  page_.setResult(changed);
  EXPECT_TRUE(csv("Lengths of the node").contains("B,12.5,0"));
}

TEST_F(ExtrinsicPageTest, ColourisesTheCloud) {
  page_.setResult(demo_.result);
  page_.setSceneData(0, demo_.clouds[0], demo_.images[0]);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        return page_.colors()->view()->scene() && page_.colors()->view()->scene()->size() > 0;
      },
      10'000));
  EXPECT_FALSE(page_.colors()->view()->scene()->has_scale);
}

TEST_F(ExtrinsicPageTest, TwoScenesHaveNoInfluenceAndNoResultIsSaid) {
  auto changed = std::make_shared<CalibrationResult>(*demo_.result);
  changed->extrinsic.leave_one_out.clear();
  page_.setResult(changed);
  page_.setResult(nullptr);
  EXPECT_TRUE(
      page_.findChild<QTextBrowser*>("pose")->toPlainText().contains("Run the calibration"));
  QSignalSpy activated(&page_, &ExtrinsicPage::sceneActivated);
  for (auto* plot : page_.findChildren<CategoryPlot*>()) {
    QTest::mouseClick(plot, Qt::LeftButton, {}, plot->rect().center());
  }
  EXPECT_EQ(activated.size(), 0);
}

}  // namespace
}  // namespace lvcalib::widgets::extrinsic_page_test
