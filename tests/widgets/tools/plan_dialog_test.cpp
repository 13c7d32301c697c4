// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/plan_dialog.h"

#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QFile>
#include <QGuiApplication>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QTreeWidget>

#include <gtest/gtest.h>

#include "tools/plan_text.h"
#include "views/board_sketch.h"
#include "widgets/support/calibrated_demo.h"
#include "widgets/support/driver.h"

namespace lvcalib::widgets::plan_dialog_test {
namespace {

using test::find;

class PlanDialogTest : public ::testing::Test {
 protected:
  static void TearDownTestSuite() { EXPECT_TRUE(Runner::wait_for_workers(60'000)); }
  void show(PlanBasis basis) {
    dialog_ = std::make_unique<PlanDialog>(std::move(basis), answers_, folder_.path());
    dialog_->setAttribute(Qt::WA_DeleteOnClose, false);
    dialog_->show();
  }
  static PlanBasis of_result() {
    const auto& result = test::calibrated_demo().result;
    return {result->target, result->camera, {}, result, {}};
  }
  template <class T>
  T& part(const char* name) {
    return *find<T>(*dialog_, name);
  }
  QString message() { return part<QLabel>("plan_message").text(); }
  QTreeWidget& table() { return part<QTreeWidget>("plan_table"); }
  void choose_lidar(const QString& data) {
    auto& box = part<QComboBox>("plan_lidar");
    ASSERT_GE(box.findData(data), 0) << data.toStdString();
    box.setCurrentIndex(box.findData(data));
  }
  void tick(const QString& effect) {
    auto& list = part<QListWidget>("plan_effects");
    for (int i = 0; i < list.count(); ++i) {
      if (list.item(i)->data(Qt::UserRole).toString() == effect)
        return list.item(i)->setCheckState(Qt::Checked);
    }
    ADD_FAILURE() << effect.toStdString();
  }
  bool planned() {
    part<QPushButton>("plan_start").click();
    return test::wait_until([this] { return !dialog_->busy(); }, 100'000) && dialog_->plan();
  }
  double sigma(int row) { return table().topLevelItem(row)->text(4).section(' ', 0, 0).toDouble(); }

  QTemporaryDir folder_;
  test::Answers answers_;
  std::unique_ptr<PlanDialog> dialog_;
};

TEST_F(PlanDialogTest, PlansFromFilesWithoutADataset) {
  show({});
  EXPECT_FALSE(part<QPushButton>("plan_start").isEnabled());
  EXPECT_TRUE(message().contains("target.yaml"));
  EXPECT_FALSE(part<QCheckBox>("plan_go_on").isVisible());
  const auto write = [this](const char* name, const std::string& text) {
    QFile file(folder_.filePath(QLatin1String(name)));
    EXPECT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(QByteArray::fromStdString(text));
    return file.fileName();
  };
  const auto& result = *test::calibrated_demo().result;
  answers_.target = write("broken.yaml", "target_type: nothing\n");
  part<QPushButton>("plan_browse_board").click();
  EXPECT_TRUE(message().contains("broken.yaml")) << message().toStdString();
  answers_.target = write("board.yaml", to_yaml(result.target));
  answers_.camera = write("cam.yaml", to_yaml(result.camera));
  part<QPushButton>("plan_browse_board").click();
  EXPECT_TRUE(message().contains("camera.yaml")) << message().toStdString();
  part<QPushButton>("plan_browse_camera").click();
  EXPECT_EQ(part<QLabel>("plan_board").text(), "board.yaml");
  EXPECT_EQ(part<QLabel>("plan_camera").text(), "cam.yaml");
  choose_lidar("avia.yaml");
  part<QSpinBox>("plan_scenes").setValue(3);
  tick("range_walk");
  ASSERT_TRUE(planned()) << message().toStdString();
  ASSERT_EQ(table().topLevelItemCount(), 3);
  // Every scene makes it surer.
  EXPECT_GT(sigma(1), sigma(2));
  EXPECT_GT(sigma(2), 0.0);
  EXPECT_EQ(table().columnCount(), 7);
  EXPECT_EQ(table().headerItem()->text(6), "Range walk");
  EXPECT_TRUE(table().topLevelItem(2)->text(6).endsWith(QString::fromUtf8("σ")));
  // The chosen pose is drawn.
  const auto* sketch = dialog_->findChild<BoardSketch*>();
  const QPolygonF first = sketch->outline();
  EXPECT_FALSE(first.isEmpty());
  EXPECT_EQ(sketch->shapes(), result.target.tags().size() + result.target.nodes().size());
  table().setCurrentItem(table().topLevelItem(2));
  EXPECT_NE(sketch->outline(), first);
  EXPECT_TRUE(
      part<QLabel>("plan_pose").text().contains(board_place(dialog_->plan()->scenes[2].pose)));
  // Out of the window.
  part<QPushButton>("plan_copy").click();
  const QString text = QGuiApplication::clipboard()->text();
  EXPECT_EQ(text.count('\n'), 3);
  EXPECT_TRUE(text.startsWith("1. "));
  answers_.export_to = folder_.filePath("plan");
  part<QPushButton>("plan_save").click();
  EXPECT_TRUE(QFile::exists(folder_.filePath("plan.json")));
  answers_.export_to = folder_.filePath("none/plan.json");
  part<QPushButton>("plan_save").click();
  EXPECT_TRUE(message().contains("none")) << message().toStdString();
}

TEST_F(PlanDialogTest, GoesOnFromTheScenesTaken) {
  show(of_result());
  EXPECT_EQ(part<QComboBox>("plan_lidar").currentData().toString(), "scenes");
  auto& go_on = part<QCheckBox>("plan_go_on");
  EXPECT_TRUE(go_on.isChecked());
  part<QSpinBox>("plan_scenes").setValue(2);
  ASSERT_TRUE(planned()) << message().toStdString();
  ASSERT_EQ(table().topLevelItemCount(), 3);
  const Matrix6d& known = test::calibrated_demo().result->extrinsic.camera_from_lidar.covariance;
  EXPECT_TRUE(table().topLevelItem(0)->text(4).startsWith(sigma_text(sigma_mm(known))));
  EXPECT_LT(sigma_mm(dialog_->plan()->scenes[0].covariance), sigma_mm(known));
  EXPECT_EQ(dialog_->plan()->camera_from_lidar.translation,
            test::calibrated_demo().result->extrinsic.camera_from_lidar.transform.translation);
  // From nothing: the first scene alone says less than the scenes taken and one.
  const Matrix6d after_one = dialog_->plan()->scenes[0].covariance;
  go_on.setChecked(false);
  ASSERT_TRUE(planned());
  EXPECT_EQ(table().topLevelItemCount(), 2);
  EXPECT_GT(dialog_->plan()->scenes[0].covariance.determinant(), after_one.determinant());
}

TEST_F(PlanDialogTest, WhatCannotBePlannedIsSaidInWords) {
  show(of_result());
  choose_lidar("avia.yaml");
  QFile file(folder_.filePath("behind.yaml"));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(
      "name: Backwards\npattern: rosette\nazimuth_fov_deg: [170, 190]\n"
      "elevation_fov_deg: [-5, 5]\npoints_per_scene: 100000\nrange_noise_mm: 8\n"
      "beam_mrad: 1.0\n");
  file.close();
  answers_.lidar = file.fileName();
  choose_lidar("choose");
  EXPECT_EQ(part<QComboBox>("plan_lidar").currentText(), "Backwards");
  EXPECT_FALSE(planned());
  EXPECT_TRUE(message().contains("in view of both sensors")) << message().toStdString();
  EXPECT_EQ(table().topLevelItemCount(), 0);
  // An effect that one scene cannot show stays hard to test, by its name.
  choose_lidar("avia.yaml");
  part<QSpinBox>("plan_scenes").setValue(1);
  tick("axis_wobble");
  part<QCheckBox>("plan_go_on").setChecked(false);
  ASSERT_TRUE(planned()) << message().toStdString();
  EXPECT_TRUE(message().contains("stays hard to test")) << message().toStdString();
  EXPECT_FALSE(message().contains("axis_wobble"));
}

TEST_F(PlanDialogTest, CanBeCancelled) {
  show(of_result());
  part<QSpinBox>("plan_scenes").setValue(100);
  part<QPushButton>("plan_start").click();
  EXPECT_TRUE(dialog_->busy());
  EXPECT_TRUE(part<QPushButton>("plan_cancel").isVisible());
  part<QPushButton>("plan_cancel").click();
  ASSERT_TRUE(test::wait_until([this] { return !dialog_->busy(); }, 10'000));
  EXPECT_EQ(dialog_->plan(), nullptr);
  EXPECT_TRUE(part<QPushButton>("plan_start").isEnabled());
  EXPECT_TRUE(message().contains("Cancelled"));
}

}  // namespace
}  // namespace lvcalib::widgets::plan_dialog_test
