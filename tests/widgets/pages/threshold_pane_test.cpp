// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/threshold_pane.h"

#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

#include "views/threshold_plot.h"
#include "widgets/support/calibrated_demo.h"

namespace lvcalib::widgets::threshold_pane_test {
namespace {

class ThresholdPaneTest : public ::testing::Test {
 protected:
  ThresholdPaneTest() {
    pane_.setResult(demo_.result);
    pane_.resize(700, 600);
    pane_.show();
  }
  ThresholdPlot& plot(const char* name) { return *pane_.findChild<ThresholdPlot*>(name); }
  QPushButton& button(const char* name) { return *pane_.findChild<QPushButton*>(name); }
  QString preview() { return pane_.findChild<QLabel*>("gate_preview")->text(); }

  const test::CalibratedDemo& demo_ = test::calibrated_demo();
  ThresholdPane pane_;
};

TEST_F(ThresholdPaneTest, ShowsEveryTagAndCircleAndTheGateInForce) {
  std::size_t tags = 0;
  for (const SceneResult& scene : demo_.result->scenes)
    tags += static_cast<std::size_t>(scene.view->tag_count);
  EXPECT_EQ(static_cast<std::size_t>(plot("gate_tags").csv().count('\n')), tags + 1);
  EXPECT_GT(plot("gate_circles").csv().count('\n'), 10);
  EXPECT_EQ(plot("gate_tags").threshold(), demo_.result->options.extrinsic.rejection_gate);
  EXPECT_FALSE(button("use_gate").isEnabled());
}

// The line is no oracle: what the solve used is not drawn as refused, wherever it lies.
TEST_F(ThresholdPaneTest, OnlyWhatIsRefusedIsRed) {
  CalibrationResult other = *demo_.result;
  std::vector<NodeResidual>& nodes = other.extrinsic.scenes[1].nodes;
  ASSERT_GT(nodes.size(), 2U);
  nodes[0].residual_m = Eigen::Vector3d(0.05, 0.05, 0.0);  // Far beyond, and used.
  nodes[1].used = false;
  pane_.setResult(std::make_shared<const CalibrationResult>(other));
  EXPECT_EQ(plot("gate_circles").csv().count(",1\n"), 1)
      << plot("gate_circles").csv().toStdString();
  QTest::keyClick(&plot("gate_circles"), Qt::Key_Right);
  other.options.extrinsic.rejection_gate = plot("gate_circles").threshold();
  nodes[2].used = false;
  pane_.setPreview(*demo_.result, other);
  EXPECT_EQ(plot("gate_circles").csv().count(",1\n"), 2);
}

TEST_F(ThresholdPaneTest, BothLinesMoveTogetherAndAskForAPreview) {
  QSignalSpy wanted(&pane_, &ThresholdPane::previewWanted);
  QTest::keyClick(&plot("gate_circles"), Qt::Key_Left);
  ASSERT_EQ(wanted.count(), 1);
  const double gate = wanted[0][0].toDouble();
  EXPECT_LT(gate, demo_.result->options.extrinsic.rejection_gate);
  EXPECT_EQ(plot("gate_tags").threshold(), gate);
  QSignalSpy used(&pane_, &ThresholdPane::gateWanted);
  QTest::mouseClick(&button("use_gate"), Qt::LeftButton);
  ASSERT_EQ(used.count(), 1);
  EXPECT_EQ(used[0][0].toDouble(), gate);
  QSignalSpy dropped(&pane_, &ThresholdPane::previewDropped);
  QTest::mouseClick(&button("drop_gate"), Qt::LeftButton);
  EXPECT_EQ(dropped.count(), 1);
  EXPECT_EQ(plot("gate_tags").threshold(), demo_.result->options.extrinsic.rejection_gate);
}

TEST_F(ThresholdPaneTest, APreviewNamesWhatGoesAndTheMove) {
  CalibrationResult other = *demo_.result;
  other.options.extrinsic.rejection_gate = 2.5;
  other.extrinsic.camera_from_lidar.transform.translation.x() += 4e-4;
  const int tag = other.extrinsic.scenes[1].corners.front().feature_id;
  for (CornerResidual& corner : other.extrinsic.scenes[1].corners)
    corner.used = corner.feature_id != tag;
  pane_.setPreview(*demo_.result, other);
  EXPECT_TRUE(preview().contains("With 2.5 σ")) << preview().toStdString();
  EXPECT_TRUE(preview().contains(QString("Newly left out: B: tag %1.").arg(tag)));
  EXPECT_TRUE(preview().contains("move by 0.400 mm"));
  pane_.setPreview(other, *demo_.result);
  EXPECT_TRUE(preview().contains(QString("Used again: B: tag %1.").arg(tag)));
}

TEST_F(ThresholdPaneTest, WithoutAResultThereIsNothingToDrag) {
  pane_.setResult(nullptr);
  EXPECT_TRUE(plot("gate_tags").csv().isEmpty());
  EXPECT_FALSE(button("use_gate").isEnabled());
}

}  // namespace
}  // namespace lvcalib::widgets::threshold_pane_test
