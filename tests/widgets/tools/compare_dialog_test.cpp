// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare_dialog.h"

#include <QPushButton>
#include <QTemporaryDir>
#include <QTreeWidget>

#include <gtest/gtest.h>

#include "report/result_file.h"
#include "widgets/support/driver.h"

namespace lvcalib::widgets::compare_dialog_test {
namespace {

using test::find;

// An extrinsic with 1 mm and 1 mrad of uncertainty, moved along the camera's x axis.
std::shared_ptr<CalibrationResult> result_at(double x_mm) {
  auto out = std::make_shared<CalibrationResult>();
  auto& pose = out->extrinsic.camera_from_lidar;
  pose.transform.translation = {0.1 + 1e-3 * x_mm, 0.2, 0.3};
  pose.covariance = 1e-6 * Matrix6d::Identity();
  out->covariance_total = pose.covariance;
  return out;
}

class CompareDialogTest : public ::testing::Test {
 protected:
  QString write(double x_mm) {
    const auto folder = folder_.filePath(QString::number(x_mm)).toStdString();
    EXPECT_TRUE(write_results(*result_at(x_mm), folder).ok());
    return QString::fromStdString(folder + "/result.json");
  }
  QString verdict() { return find<QLabel>(dialog_, "compare_verdict")->text(); }
  QString cell(int row, int column) {
    return find<QTreeWidget>(dialog_, "compare_table")->topLevelItem(row)->text(column);
  }
  QTemporaryDir folder_;
  test::Answers answers_;
  CompareDialog dialog_{result_at(0.0), answers_, folder_.path()};
};

TEST_F(CompareDialogTest, ShowsTheDifferenceWithBothUncertainties) {
  dialog_.open(write(1.0));
  EXPECT_EQ(cell(0, 1), "1.000");
  EXPECT_EQ(cell(0, 2), "1.000");
  EXPECT_EQ(cell(0, 3), "1.000");
  EXPECT_EQ(cell(0, 4), "1.414");
  EXPECT_EQ(cell(0, 5), "0.71");
  EXPECT_EQ(cell(3, 1), "0.000");
  EXPECT_TRUE(verdict().contains("1.000 mm")) << verdict().toStdString();
  EXPECT_TRUE(verdict().contains("agree"));
}

TEST_F(CompareDialogTest, EqualResultsHaveNoSignsAndPlainPercents) {
  dialog_.open(write(0.0));
  for (int k = 0; k < 6; ++k) EXPECT_EQ(cell(k, 1), "0.000");
  EXPECT_EQ(cell(5, 5), "0.00");
  EXPECT_TRUE(verdict().contains("in 100 % of all cases")) << verdict().toStdString();
}

TEST_F(CompareDialogTest, SaysWhenTheyContradict) {
  answers_.other_result = write(12.0);
  find<QPushButton>(dialog_, "compare_choose")->click();
  EXPECT_TRUE(verdict().contains("contradict")) << verdict().toStdString();
}

TEST_F(CompareDialogTest, TheTruthHasNoUncertainty) {
  const QString path = folder_.filePath("truth.json");
  QFile file(path);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("{\"T_CL\": [[1,0,0,0.1],[0,1,0,0.2],[0,0,1,0.3005]]}");
  file.close();
  dialog_.open(path);
  EXPECT_EQ(cell(2, 1), "0.500");
  EXPECT_EQ(cell(2, 3), QString::fromUtf8("–"));
  EXPECT_EQ(cell(2, 4), "1.000");
}

TEST_F(CompareDialogTest, AnotherFileIsOneMessage) {
  dialog_.open(folder_.filePath("nothing.json"));
  EXPECT_TRUE(verdict().contains("nothing.json"));
  EXPECT_EQ(find<QTreeWidget>(dialog_, "compare_table")->topLevelItemCount(), 0);
}

}  // namespace
}  // namespace lvcalib::widgets::compare_dialog_test
