// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialogs/export_pane.h"

#include <QClipboard>
#include <QComboBox>
#include <QFile>
#include <QGuiApplication>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include "base/file_io.h"

namespace lvcalib::widgets::export_pane_test {
namespace {

class Answers : public Choices {
 public:
  QString save, transform, suggested, made;
  QString file_to_export(QWidget*, const QString& suggestion, const QString&) override {
    suggested = suggestion;
    return save;
  }
  QString transform_to_open(QWidget*, const QString&) override { return transform; }
  QString dataset_to_make(QWidget*, const QString&) override { return made; }
  bool hand_on_failed(QWidget*) override {
    ++asked;
    return all_the_same;
  }
  int asked = 0;
  bool all_the_same = false;
};

ExportInput example() {
  ExportInput input;
  input.camera_from_lidar = {so3_exp({1.2, -1.1, 1.0}), {0.1, -0.2345, 0.3}};
  input.camera.fx = input.camera.fy = 800.0;
  input.camera.cx = 500.0;
  input.camera.cy = 320.0;
  input.camera.width_px = 1000;
  input.camera.height_px = 640;
  input.dataset = "/data/rig";
  input.quality = "good";
  input.scenes = {{"A", true, "scenes/A/image.png", "scenes/A/cloud.pcd", {}}};
  return input;
}

class ExportPaneTest : public ::testing::Test {
 protected:
  template <class T>
  [[nodiscard]] T* part(const char* name) const {
    return pane_.findChild<T*>(QString::fromLatin1(name));
  }
  [[nodiscard]] QString preview() const { return part<QPlainTextEdit>("preview")->toPlainText(); }
  QTemporaryDir folder_;
  Answers answers_;
  ExportPane pane_{example(), answers_, folder_.path(), nullptr};
  QSignalSpy failed_{&pane_, &ExportPane::failed};
  QSignalSpy exported_{&pane_, &ExportPane::exported};
};

TEST_F(ExportPaneTest, EveryFormatIsPreviewedAsItWouldBeWritten) {
  const auto* list = part<QListWidget>("formats");
  ASSERT_EQ(list->count(), static_cast<int>(export_formats().size()));
  for (const ExportFormat& format : export_formats()) {
    pane_.chooseFormat(QString::fromStdString(format.name));
    const auto text = export_result(example(), format.name);
    EXPECT_EQ(preview().toStdString(), text ? *text : std::string()) << format.name;
    EXPECT_EQ(part<QPushButton>("save_export")->isEnabled(), text.ok()) << format.name;
  }
}

TEST_F(ExportPaneTest, CopyAndSaveGiveTheSameText) {
  pane_.chooseFormat("kalibr");
  part<QPushButton>("copy_export")->click();
  EXPECT_EQ(QGuiApplication::clipboard()->text(), preview());
  answers_.save = folder_.filePath("camchain.yaml");
  part<QPushButton>("save_export")->click();
  EXPECT_TRUE(answers_.suggested.endsWith("/kalibr.yaml")) << answers_.suggested.toStdString();
  ASSERT_EQ(exported_.size(), 1);
  EXPECT_EQ(*read_text_file(answers_.save.toStdString(), 1 << 20), preview().toStdString());
  // A place that cannot be written is named.
  answers_.save = folder_.filePath("no/such/camchain.yaml");
  part<QPushButton>("save_export")->click();
  ASSERT_EQ(failed_.size(), 1);
  EXPECT_NE(failed_[0][0].value<Error>().text().find("no/such"), std::string::npos);
}

TEST_F(ExportPaneTest, AFormatOfSeveralFilesIsAFolder) {
  pane_.chooseFormat("colmap");
  EXPECT_TRUE(preview().contains("=== cameras.txt"));
  answers_.made = folder_.filePath("model");
  part<QPushButton>("save_export")->click();
  ASSERT_EQ(exported_.size(), 1);
  EXPECT_TRUE(QFile::exists(folder_.filePath("model/images.txt")));
  EXPECT_TRUE(part<QComboBox>("export_scene")->isHidden());
}

TEST_F(ExportPaneTest, ACloudIsWrittenInTheBackgroundAndSaysWhatIsMissing) {
  pane_.chooseFormat("colored-ply");
  EXPECT_FALSE(part<QComboBox>("export_scene")->isHidden());
  EXPECT_EQ(part<QComboBox>("export_scene")->currentText(), "A");
  EXPECT_FALSE(part<QPushButton>("copy_export")->isEnabled());
  answers_.save = folder_.filePath("a.ply");
  part<QPushButton>("save_export")->click();
  EXPECT_FALSE(part<QPushButton>("save_export")->isEnabled());
  ASSERT_TRUE(QTest::qWaitFor([this] { return failed_.size() == 1; }, 10'000));
  EXPECT_NE(failed_[0][0].value<Error>().text().find("image.png"), std::string::npos);
  EXPECT_TRUE(
      QTest::qWaitFor([this] { return part<QPushButton>("save_export")->isEnabled(); }, 10'000));
  EXPECT_FALSE(QFile::exists(answers_.save));
}

TEST_F(ExportPaneTest, AFailedResultIsExportedOnlyIfTheUserInsists) {
  ExportInput bad = example();
  bad.quality = "failed";
  ExportPane pane(bad, answers_, folder_.path(), nullptr);
  pane.chooseFormat("kalibr");
  answers_.save = folder_.filePath("bad.yaml");
  pane.findChild<QPushButton*>("save_export")->click();
  EXPECT_EQ(answers_.asked, 1);
  EXPECT_FALSE(QFile::exists(answers_.save));
  answers_.all_the_same = true;
  pane.findChild<QPushButton*>("save_export")->click();
  EXPECT_TRUE(QFile::exists(answers_.save));
}

TEST_F(ExportPaneTest, AMissingImuIsAskedFor) {
  pane_.chooseFormat("r3live");
  EXPECT_TRUE(preview().isEmpty());
  EXPECT_FALSE(part<QPushButton>("choose_imu")->isHidden());
  EXPECT_TRUE(part<QLabel>("format_about")->text().contains("T_imu_lidar"));
  QFile bad(folder_.filePath("bad.yaml"));
  ASSERT_TRUE(bad.open(QIODevice::WriteOnly));
  bad.write("T_imu_lidar: [1, 2]\n");
  bad.close();
  answers_.transform = bad.fileName();
  part<QPushButton>("choose_imu")->click();
  ASSERT_EQ(failed_.size(), 1);
  EXPECT_TRUE(preview().isEmpty());
  QFile good(folder_.filePath("imu.yaml"));
  ASSERT_TRUE(good.open(QIODevice::WriteOnly));
  good.write(
      "T_imu_lidar:\n  translation_m: [0.05, -0.02, 0.11]\n"
      "  quaternion_xyzw: [0, 0, 0, 1]\n");
  good.close();
  answers_.transform = good.fileName();
  part<QPushButton>("choose_imu")->click();
  EXPECT_EQ(failed_.size(), 1);
  EXPECT_TRUE(preview().contains("camera_ext_R"));
  EXPECT_TRUE(part<QPushButton>("save_export")->isEnabled());
  pane_.chooseFormat("matrix");
  EXPECT_TRUE(part<QPushButton>("choose_imu")->isHidden());
}

TEST_F(ExportPaneTest, AResultWithoutBoundaryResponseSaysWhy) {
  pane_.chooseFormat("boundary-response");
  const auto text = export_result(example(), "boundary-response");
  ASSERT_FALSE(text.ok());
  EXPECT_TRUE(
      part<QLabel>("format_about")->text().contains(QString::fromStdString(text.error().text())));
  EXPECT_FALSE(part<QPushButton>("copy_export")->isEnabled());
}

// Whatever the reader of a file looks for, it finds the names that its user gave.
TEST_F(ExportPaneTest, NamesOfFramesAreInEveryFormat) {
  QFile imu(folder_.filePath("imu.yaml"));
  ASSERT_TRUE(imu.open(QIODevice::WriteOnly));
  imu.write(
      "T_imu_lidar:\n  translation_m: [0.05, -0.02, 0.11]\n"
      "  quaternion_xyzw: [0, 0, 0, 1]\n");
  imu.close();
  answers_.transform = imu.fileName();
  pane_.chooseFormat("r3live");
  part<QPushButton>("choose_imu")->click();
  for (const auto& [field, name] :
       {std::pair{"lidar_frame", "velodyne"}, std::pair{"camera_frame", "rig/left"}}) {
    part<QLineEdit>(field)->clear();
    QTest::keyClicks(part<QLineEdit>(field), name);
  }
  int shown = 0;
  for (const ExportFormat& format : export_formats()) {
    pane_.chooseFormat(QString::fromStdString(format.name));
    if (preview().isEmpty()) continue;  // No text, or no boundary response in this example.
    ++shown;
    EXPECT_TRUE(preview().contains("velodyne")) << format.name;
    EXPECT_TRUE(preview().contains("rig/left")) << format.name;
  }
  EXPECT_GE(shown, static_cast<int>(export_formats().size()) - 2);
}

TEST_F(ExportPaneTest, FramesAreCalledWhatTheUserCallsThem) {
  QSignalSpy names(&pane_, &ExportPane::frameNamesChanged);
  pane_.chooseFormat("ros2-tf");
  EXPECT_TRUE(preview().contains("--frame-id lidar"));
  auto* lidar = part<QLineEdit>("lidar_frame");
  lidar->clear();
  EXPECT_EQ(names.count(), 0);
  QTest::keyClicks(lidar, "velodyne");
  EXPECT_TRUE(preview().contains("--frame-id velodyne"));
  ASSERT_GE(names.count(), 1);
  EXPECT_EQ(names.last().first().toString(), "velodyne");
  QTest::keyClicks(lidar, " 2");
  EXPECT_TRUE(preview().isEmpty());
  EXPECT_TRUE(part<QLabel>("format_about")->text().contains("velodyne 2"));
}

}  // namespace
}  // namespace lvcalib::widgets::export_pane_test
