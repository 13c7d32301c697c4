// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/methods_pane.h"

#include <QLabel>
#include <QTableWidget>

#include <gtest/gtest.h>

#include "views/category_plots.h"
#include "widgets/support/calibrated_demo.h"

namespace lvcalib::widgets::methods_pane_test {
namespace {

TEST(MethodTitle, NamesOfTheComparisonInWords) {
  EXPECT_EQ(method_title("svd_raw"), "3D-SVD, raw");
  EXPECT_EQ(method_title("wsvd_refined"), "W-SVD, refined");
  EXPECT_EQ(method_title("joint_refined"), "Joint, refined");
  EXPECT_EQ(method_title("joint_paper"), "Joint, as in the paper");
  EXPECT_EQ(method_title("forward_model"), "Every return");
  EXPECT_EQ(method_title("something_else"), "something_else");
  EXPECT_EQ(method_title("joint_other"), "joint_other");
}

TEST(MethodsPane, TenMethodsWithTheResultsNumbers) {
  const CalibrationResult& result = *test::calibrated_demo().result;
  MethodsPane pane;
  pane.setResult(&result);
  const auto* table = pane.findChild<QTableWidget*>("methods");
  ASSERT_EQ(result.methods.size(), 10U);
  ASSERT_EQ(table->rowCount(), 10);
  std::size_t corners = 0;
  for (int k = 0; k < 10; ++k) {
    const MethodResult& m = result.methods[static_cast<std::size_t>(k)];
    EXPECT_EQ(table->item(k, 0)->text(), method_title(m.name));
    EXPECT_NEAR(table->item(k, 1)->text().toDouble(), m.rms_px, 6e-4);
    EXPECT_NEAR(table->item(k, 2)->text().toDouble(), m.rms_mm, 6e-3);
    ASSERT_TRUE(m.heldout_px);
    EXPECT_NEAR(table->item(k, 4)->text().toDouble(), *m.heldout_px, 6e-4);
    // Bold is what the page beside it states, and distances are from that.
    const bool chosen = m.name == "forward_model";
    EXPECT_EQ(table->item(k, 0)->font().bold(), chosen) << m.name;
    EXPECT_EQ(table->item(k, 6)->text() == "–", chosen) << m.name;
    if (!chosen) {
      const Rigid3& pose = result.extrinsic.camera_from_lidar.transform;
      EXPECT_NEAR(table->item(k, 6)->text().toDouble(),
                  1e3 * (m.camera_from_lidar.translation - pose.translation).norm(), 6e-3);
    }
    for (const MethodScene& scene : m.scenes) corners += scene.errors_px.size();
  }
  const auto boxes = pane.findChildren<BoxPlot*>();
  ASSERT_EQ(boxes.size(), 2);
  EXPECT_EQ(boxes[0]->csv().count('\n'), static_cast<qsizetype>(corners) + 1);
}

TEST(MethodsPane, AResultThatIsNotAmongThemIsSaid) {
  CalibrationResult result = *test::calibrated_demo().result;
  ASSERT_TRUE(result.forward);
  MethodsPane pane;
  const auto* message = pane.findChild<QLabel*>("methods-message");
  pane.setResult(&result);
  EXPECT_TRUE(message->text().contains("Bold: the result")) << message->text().toStdString();
  result.extrinsic.camera_from_lidar.transform.translation.x() += 0.01;
  pane.setResult(&result);
  EXPECT_TRUE(message->text().contains("Base model")) << message->text().toStdString();
  const auto* table = pane.findChild<QTableWidget*>("methods");
  for (int k = 0; k < table->rowCount(); ++k) EXPECT_FALSE(table->item(k, 0)->font().bold());
}

TEST(MethodsPane, WhatIsMissingIsSaid) {
  MethodsPane pane;
  const auto* message = pane.findChild<QLabel*>("methods-message");
  EXPECT_TRUE(message->text().contains("Run the calibration"));
  CalibrationResult result = *test::calibrated_demo().result;
  for (MethodResult& m : result.methods) m.heldout_px = m.heldout_mm = std::nullopt;
  pane.setResult(&result);
  EXPECT_TRUE(message->text().contains("Not enough scenes"));
  EXPECT_EQ(pane.findChild<QTableWidget*>("methods")->item(0, 4)->text(), "–");
  result.methods.clear();
  pane.setResult(&result);
  EXPECT_TRUE(message->text().contains("no extrinsic"));
  EXPECT_EQ(pane.findChild<QTableWidget*>("methods")->rowCount(), 0);
}

}  // namespace
}  // namespace lvcalib::widgets::methods_pane_test
