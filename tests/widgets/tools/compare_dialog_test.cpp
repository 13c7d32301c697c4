// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTreeWidget>

#include <gtest/gtest.h>

#include "pipeline/model_discovery.h"
#include "report/result_file.h"
#include "views/image_view.h"
#include "widgets/support/calibrated_demo.h"
#include "widgets/support/driver.h"

namespace lvcalib::widgets::compare_dialog_test {
namespace {

using test::find;
using Kind = ComparedResult::Kind;

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
  QString write(const CalibrationResult& result, const QString& name) {
    const auto folder = folder_.filePath(name).toStdString();
    EXPECT_TRUE(write_results(result, folder).ok());
    return QString::fromStdString(folder + "/result.json");
  }
  QString write(double x_mm) { return write(*result_at(x_mm), QString::number(x_mm)); }
  void show(ComparisonBasis basis) {
    dialog_ = std::make_unique<CompareDialog>(std::move(basis), answers_, folder_.path());
    dialog_->setAttribute(Qt::WA_DeleteOnClose, false);
    dialog_->show();
  }
  void show() { show({result_at(0.0), nullptr, {}, 0, {}}); }
  QString verdict() { return find<QLabel>(*dialog_, "compare_verdict")->text(); }
  QTreeWidget* pose() { return find<QTreeWidget>(*dialog_, "compare_table"); }
  QTreeWidget* scenes() { return find<QTreeWidget>(*dialog_, "compare_scenes"); }
  QString cell(int row, int column) { return pose()->topLevelItem(row)->text(column); }
  bool compared() {
    return test::wait_until([this] { return pose()->topLevelItemCount() == 6; }, 60'000);
  }
  bool has_picture() {
    return test::wait_until(
        [this] { return !dialog_->findChild<ImageView*>()->overlay().overlay().points.empty(); },
        10'000);
  }
  QTemporaryDir folder_;
  test::Answers answers_;
  std::unique_ptr<CompareDialog> dialog_;
};

TEST_F(CompareDialogTest, ShowsTheDifferenceWithBothUncertainties) {
  show();
  EXPECT_TRUE(verdict().contains("Choose another result"));
  dialog_->add(Kind::kFile, write(1.0));
  ASSERT_TRUE(compared());
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
  show();
  dialog_->add(Kind::kFile, write(0.0));
  ASSERT_TRUE(compared());
  for (int k = 0; k < 6; ++k) EXPECT_EQ(cell(k, 1), "0.000");
  EXPECT_EQ(cell(5, 5), "0.00");
  EXPECT_TRUE(verdict().contains("in 100 % of all cases")) << verdict().toStdString();
}

TEST_F(CompareDialogTest, TwoFilesCanBeCompared) {
  show();
  answers_.other_result = write(12.0);
  find<QPushButton>(*dialog_, "compare_file")->click();
  ASSERT_TRUE(compared());
  EXPECT_TRUE(verdict().contains("contradict")) << verdict().toStdString();
  answers_.other_result = write(14.0).replace("json", "yaml");
  find<QPushButton>(*dialog_, "compare_file")->click();
  ASSERT_TRUE(compared());
  EXPECT_EQ(cell(0, 1), "14.000");
  auto* from = find<QComboBox>(*dialog_, "compare_from");
  from->setCurrentIndex(1);
  EXPECT_EQ(pose()->topLevelItemCount(), 0);
  ASSERT_TRUE(compared());
  EXPECT_EQ(cell(0, 1), "2.000");
}

TEST_F(CompareDialogTest, TheTruthHasNoUncertainty) {
  const QString path = folder_.filePath("truth.json");
  QFile file(path);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("{\"T_CL\": [[1,0,0,0.1],[0,1,0,0.2],[0,0,1,0.3005]]}");
  file.close();
  show();
  dialog_->add(Kind::kFile, path);
  ASSERT_TRUE(compared());
  EXPECT_EQ(cell(2, 1), "0.500");
  EXPECT_EQ(cell(2, 3), QString::fromUtf8("–"));
  EXPECT_EQ(cell(2, 4), "1.000");
}

TEST_F(CompareDialogTest, AnotherFileIsOneMessage) {
  show();
  dialog_->add(Kind::kFile, folder_.filePath("nothing.json"));
  ASSERT_TRUE(test::wait_until([this] { return verdict().contains("nothing.json"); }, 10'000));
  EXPECT_EQ(pose()->topLevelItemCount(), 0);
  dialog_->add(Kind::kProject, folder_.filePath("nothing.lvcalib"));
  ASSERT_TRUE(test::wait_until([this] { return verdict().contains("nothing.lvcalib"); }, 10'000));
}

TEST_F(CompareDialogTest, StepsShowEveryScenesResidualsAndTheMoveInThePicture) {
  const auto source = test::calibrated_demo().result;
  const auto base = start_model(discovery_input(*source), discovery_options(*source), {});
  ASSERT_TRUE(base.ok()) << base.error().text();
  const auto next = add_effect(*base, "range_offset", 0.0, {});
  ASSERT_TRUE(next.ok()) << next.error().text();
  const std::vector<ModelStepPtr> steps = {*base, *next};
  const auto after =
      std::make_shared<const CalibrationResult>(with_model(*source, as_discovery(steps, nullptr)));
  show({after, source, steps, 1, {}});
  ASSERT_TRUE(compared());
  const auto& was = source->extrinsic;
  const auto& is = after->extrinsic;
  const double moved =
      translation_distance_m(was.camera_from_lidar.transform, is.camera_from_lidar.transform);
  EXPECT_GT(moved, 0.0);
  EXPECT_TRUE(verdict().contains(QString("differ by %1 mm").arg(1e3 * moved, 0, 'f', 3)));
  EXPECT_TRUE(verdict().contains("the same scenes")) << verdict().toStdString();
  ASSERT_EQ(scenes()->topLevelItemCount(), 3);
  QTreeWidgetItem* row = scenes()->topLevelItem(1);
  EXPECT_EQ(row->text(0), "B");
  EXPECT_EQ(row->text(3), QString::number(was.scenes[1].rms_mm, 'f', 3));
  EXPECT_EQ(row->text(4), QString::number(is.scenes[1].rms_mm, 'f', 3));
  const auto shift = board_shift(*after, after->scenes[1], was.camera_from_lidar.transform,
                                 is.camera_from_lidar.transform);
  ASSERT_TRUE(shift.has_value());
  EXPECT_EQ(row->text(5), QString::number(shift->rms_px, 'f', 3));
  // The picture of the scene that is chosen: its photograph is gone, what is projected is not.
  ASSERT_TRUE(has_picture());
  scenes()->setCurrentItem(row);
  ASSERT_TRUE(has_picture());
  auto* image = dialog_->findChild<ImageView*>();
  EXPECT_TRUE(image->message().contains("There is no image"));
  EXPECT_EQ(image->overlay().overlay().shifts.size(), shift->first_px.size());
  const double factor = find<QDoubleSpinBox>(*dialog_, "compare_factor")->value();
  EXPECT_EQ(image->overlay().residualFactor(), factor);
  EXPECT_LE(factor * shift->largest_px, 61.0);
  EXPECT_FALSE(image->overlay().parts().points);
  find<QCheckBox>(*dialog_, "compare_points")->click();
  EXPECT_TRUE(image->overlay().parts().points);
  // A step beside itself.
  find<QComboBox>(*dialog_, "compare_from")->setCurrentIndex(1);
  EXPECT_EQ(pose()->topLevelItemCount(), 0);
  ASSERT_TRUE(compared());
  EXPECT_TRUE(verdict().contains("differ by 0.000 mm"));
}

}  // namespace
}  // namespace lvcalib::widgets::compare_dialog_test
