// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/target_camera_dialog.h"

#include <QComboBox>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QTabWidget>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include "base/file_io.h"
#include "camera/camera_deviations.h"
#include "target/target.h"
#include "tools/camera_form.h"
#include "tools/camera_preview.h"
#include "tools/key_form.h"
#include "tools/target_form.h"
#include "widgets/support/driver.h"

namespace lvcalib::widgets::target_camera_dialog_test {
namespace {

using test::find;
using test::wait_until;

class TargetCameraDialogTest : public ::testing::Test {
 protected:
  static void TearDownTestSuite() { EXPECT_TRUE(Runner::wait_for_workers(60'000)); }
  void SetUp() override { make(); }
  void make() {
    dialog_ = std::make_unique<TargetCameraDialog>(answers_, folder_.path());
    dialog_->setAttribute(Qt::WA_DeleteOnClose, false);
    dialog_->show();
  }
  void type(const char* key, const QString& text) { find<QLineEdit>(*dialog_, key)->setText(text); }
  void choose(const char* box, const QVariant& data) {
    auto* combo = find<QComboBox>(*dialog_, box);
    ASSERT_GE(combo->findData(data), 0);
    combo->setCurrentIndex(combo->findData(data));
  }
  QPushButton& button(const char* name) { return *find<QPushButton>(*dialog_, name); }
  TargetForm& target() { return *find<TargetForm>(*dialog_, "target_form"); }
  CameraForm& camera() { return *find<CameraForm>(*dialog_, "camera_form"); }
  QString label(const QString& name) { return dialog_->findChild<QLabel*>(name)->text(); }
  QString write(const char* name, const std::string& text) {
    const QString path = folder_.filePath(QLatin1String(name));
    EXPECT_TRUE(write_file_atomically(path.toStdString(), text).ok());
    return path;
  }

  QTemporaryDir folder_;
  test::Answers answers_;
  std::unique_ptr<TargetCameraDialog> dialog_;
};

Target checkerboard() {
  Target out;
  out.type = TargetType::kCheckerboard;
  out.corner_columns = 7;
  out.corner_rows = 5;
  out.column_spacing_m = out.row_spacing_m = 0.095;
  out.board_width_m = 0.85;
  out.board_height_m = 0.65;
  out.board_offset_m = {0.002, -0.001};
  return out;
}

Target charuco() {
  Target out;
  out.type = TargetType::kCharuco;
  out.tag_family = "DICT_5X5_250";
  out.corner_columns = 6;
  out.corner_rows = 4;
  out.column_spacing_m = out.row_spacing_m = 0.09;
  out.tag_size_m = 0.066;
  out.first_tag_id = 12;
  out.legacy_pattern = true;
  out.board_width_m = 0.7;
  out.board_height_m = 0.5;
  return out;
}

Target single_tag() {
  Target out;
  out.type = TargetType::kAprilTag;
  out.tag_family = "tag25h9";
  out.first_tag_id = 4;
  out.tag_size_m = 0.5;
  out.board_width_m = out.board_height_m = 0.8;
  return out;
}

TEST_F(TargetCameraDialogTest, EveryKindOfBoardIsShownAndWrittenAsItIs) {
  Target grid;
  grid.type = TargetType::kAprilGrid;
  grid.first_tag_id = 3;
  grid.size_sigma = 0.001;
  for (const Target& board : {Target{}, grid, checkerboard(), charuco(), single_tag()}) {
    dialog_->openTarget(write("board.yaml", to_yaml(board)));
    ASSERT_TRUE(target().target().has_value()) << target().text();
    EXPECT_EQ(to_yaml(*target().target()), to_yaml(board)) << target().text();
    EXPECT_FALSE(button("target_camera_save").isEnabled()) << "nothing was changed";
  }
}

TEST_F(TargetCameraDialogTest, WhatTheReaderSaysStandsBesideTheField) {
  type("circleRadius", "75");  // They would run into the tags.
  EXPECT_TRUE(target().keys().complaint("circleRadius").contains("circles run into the tags"))
      << target().keys().complaint("circleRadius").toStdString();
  EXPECT_FALSE(button("target_camera_save").isEnabled());
  type("circleRadius", "45");
  EXPECT_TRUE(target().keys().complaint("circleRadius").isEmpty());
  EXPECT_TRUE(button("target_camera_save").isEnabled());
  type("tagCols", "four");
  EXPECT_TRUE(target().keys().complaint("tagCols").contains("four"));
  type("tagCols", "");
  EXPECT_TRUE(target().keys().complaint("tagCols").contains("missing"));
  type("tagCols", "4\n]");  // Nothing that is typed makes another file of it.
  EXPECT_FALSE(target().keys().complaint("tagCols").isEmpty());
  type("tagCols", "4");
  // What concerns no one field is said below them.
  type("firstTagId", "600");
  EXPECT_TRUE(label("target_problem").contains("tag36h11"))
      << label("target_problem").toStdString();
  EXPECT_FALSE(target().target().has_value());
}

TEST_F(TargetCameraDialogTest, LengthsAreMillimetresOnScreenAndMetresInTheFile) {
  EXPECT_EQ(find<QLineEdit>(*dialog_, "tagSize")->text(), "120");
  type("tagSize", "99.7");
  answers_.export_to = folder_.filePath("made");
  QSignalSpy saved(dialog_.get(), &TargetCameraDialog::targetSaved);
  button("target_camera_save").click();
  ASSERT_EQ(saved.size(), 1);
  EXPECT_EQ(saved[0][0].toString(), answers_.export_to + ".yaml");
  const auto read = read_target(saved[0][0].toString().toStdString());
  ASSERT_TRUE(read.ok()) << read.error().text();
  EXPECT_DOUBLE_EQ(read->target.tag_size_m, 0.0997);
  EXPECT_TRUE(read->warnings.empty());
  EXPECT_FALSE(button("target_camera_save").isEnabled()) << "it is saved";
  type("tagSize", "98");
  EXPECT_TRUE(label("target_camera_file").contains("changed"));
  button("target_camera_save").click();  // Without another question.
  EXPECT_DOUBLE_EQ(read_target(saved[1][0].toString().toStdString())->target.tag_size_m, 0.098);
}

TEST_F(TargetCameraDialogTest, TheBoardIsDrawnAsItWouldBePrinted) {
  const auto picture = [&] { return find<QLabel>(*dialog_, "target_preview")->pixmap().toImage(); };
  ASSERT_TRUE(wait_until([&] { return !picture().isNull(); }, 20'000));
  const QImage with_circles = picture();
  choose("target_type", "aprilgrid");
  ASSERT_TRUE(wait_until([&] { return picture() != with_circles; }, 20'000));
  type("tagSize", "-1");
  EXPECT_TRUE(wait_until([&] { return picture().isNull(); }, 20'000)) << "there is no such board";
}

TEST_F(TargetCameraDialogTest, AFileThatCannotBeReadLeavesTheFormAsItIs) {
  type("tagSize", "80");
  answers_.target = write("broken.yaml", "tagCols: [");
  button("target_camera_open").click();
  EXPECT_TRUE(label("target_camera_problem").contains("broken.yaml"));
  EXPECT_EQ(find<QLineEdit>(*dialog_, "tagSize")->text(), "80");
  answers_.export_to = folder_.filePath("no/such/folder/target.yaml");
  button("target_camera_save").click();
  EXPECT_TRUE(label("target_camera_problem").contains("no/such/folder"));
  EXPECT_TRUE(label("target_camera_file").contains("Not saved"));
}

Camera fisheye() {
  Camera out;
  out.width_px = 1280;
  out.height_px = 960;
  out.fx = 611.25;
  out.fy = 610.75;
  out.cx = 640.5;
  out.cy = 478.125;
  out.model = DistortionModel::kEquidistant;
  out.distortion.head<4>() << 0.0123456789012, -0.004, 0.001, -0.0002;
  out.name = "front \"left\"";
  return out;
}

TEST_F(TargetCameraDialogTest, ACameraIsShownAndWrittenAsItIs) {
  CameraDeviations deviations = CameraDeviations::Constant(-1.0);
  deviations.head<4>() << 0.25, 0.25, 0.5, 0.5;
  dialog_->openCamera(write("camera.yaml", to_yaml(fisheye(), deviations)));
  dialog_->showPage(TargetCameraDialog::Page::kCamera);
  ASSERT_TRUE(camera().camera().has_value()) << camera().text();
  Camera expected = fisheye();
  expected.name = "front left";  // Quotes have no place in a name.
  EXPECT_EQ(to_yaml(*camera().camera()), to_yaml(expected));
  EXPECT_EQ(find<QLineEdit>(*dialog_, "fx sigma")->text(), "0.25");
  EXPECT_TRUE(find<QLineEdit>(*dialog_, "k1 sigma")->text().isEmpty());
  type("k1 sigma", "0.001");
  answers_.export_to = folder_.filePath("camera-2.yaml");
  QSignalSpy saved(dialog_.get(), &TargetCameraDialog::cameraSaved);
  button("target_camera_save_as").click();
  ASSERT_EQ(saved.size(), 1);
  const auto again = read_camera_deviations(answers_.export_to.toStdString(), fisheye());
  ASSERT_TRUE(again.ok() && again->has_value());
  EXPECT_DOUBLE_EQ((**again)(4), 0.001);
  EXPECT_DOUBLE_EQ((**again)(2), 0.5);
  EXPECT_LT((**again)(5), 0.0) << "not stated";
}

TEST_F(TargetCameraDialogTest, CamerasOfOtherFormatsAreOpenedToo) {
  dialog_->openCamera(write("camchain.yaml",
                            "cam0:\n  camera_model: pinhole\n  intrinsics: [500, 501, 320, 240]\n"
                            "  distortion_model: radtan\n"
                            "  distortion_coeffs: [-0.3, 0.1, 0.001, -0.002]\n"
                            "  resolution: [640, 480]\n"));
  ASSERT_TRUE(camera().camera().has_value());
  EXPECT_EQ(camera().camera()->fy, 501.0);
  EXPECT_EQ(find<QLineEdit>(*dialog_, "p2")->text(), "-0.002");
}

TEST_F(TargetCameraDialogTest, WhatIsWrongWithACameraStandsBesideItsField) {
  dialog_->showPage(TargetCameraDialog::Page::kCamera);
  EXPECT_TRUE(camera().keys().complaint("image_width").contains("missing"));
  for (const auto& [key, value] : {std::pair("image_width", "640"),
                                   {"image_height", "480"},
                                   {"fx", "500"},
                                   {"fy", "0.5"},
                                   {"cx", "320"},
                                   {"cy", "240"}})
    type(key, value);
  EXPECT_TRUE(camera().keys().complaint("fy").contains("focal length"));
  EXPECT_TRUE(camera().keys().complaint("fx").isEmpty());
  type("fy", "500");
  ASSERT_TRUE(camera().camera().has_value());
  EXPECT_TRUE(label("camera_view").contains("65.")) << label("camera_view").toStdString();
  type("k1", "much");
  EXPECT_FALSE(camera().keys().complaint("k1").isEmpty());
  type("k1", "0");
  type("fx sigma", "-1");
  EXPECT_FALSE(camera().keys().complaint("fx").isEmpty());
  EXPECT_FALSE(button("target_camera_save").isEnabled());
  type("fx sigma", "");
  type("k1", "-3");  // Folds back before the corners: a warning, the file can be written.
  EXPECT_TRUE(label("camera_problem").contains("folds back"));
  EXPECT_TRUE(button("target_camera_save").isEnabled());
}

TEST_F(TargetCameraDialogTest, WhatLiesInTheFolderIsOpened) {
  write("target.yaml", to_yaml(checkerboard()));
  write("camera.yaml", to_yaml(fisheye()));
  make();
  EXPECT_EQ(target().target()->type, TargetType::kCheckerboard);
  EXPECT_EQ(camera().camera()->model, DistortionModel::kEquidistant);
  EXPECT_TRUE(label("target_camera_file").endsWith("target.yaml"));
}

TEST(FieldOfView, IsThatOfThePinhole) {
  Camera camera;
  camera.width_px = 641;
  camera.height_px = 481;
  camera.fx = camera.fy = 320.0;
  camera.cx = 320.0;
  camera.cy = 240.0;
  const auto view = field_of_view(camera);
  ASSERT_TRUE(view.has_value());
  EXPECT_NEAR(view->x(), 2.0 * std::atan(1.0), 1e-9);
  EXPECT_NEAR(view->y(), 2.0 * std::atan(0.75), 1e-9);
}

}  // namespace
}  // namespace lvcalib::widgets::target_camera_dialog_test
