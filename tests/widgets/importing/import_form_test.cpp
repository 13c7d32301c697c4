// SPDX-License-Identifier: GPL-3.0-or-later
#include "importing/import_form.h"

#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFile>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/target_camera_dialog.h"
#include "widgets/importing/recorded_walk.h"
#include "widgets/support/driver.h"

namespace lvcalib::widgets::import_form_test {
namespace {

using test::find;

class ImportFormTest : public ::testing::Test {
 protected:
  ImportFormTest() : form_(answers_, {}) {
    auto recording = Recording::open(test::small_walk().path.toStdString(), {});
    opened_.recording = std::make_shared<const Recording>(std::move(*recording));
    opened_.candidates = list_candidates(*opened_.recording);
    opened_.info_of_images = {opened_.candidates.infos.front()};
  }
  QString write(const char* name, const std::string& text) {
    const QString path = folder_.filePath(QLatin1String(name));
    test::write_bytes(path.toStdString(), text);
    return path;
  }
  void choose(const char* box, const char* data) {
    auto* combo = find<QComboBox>(form_, box);
    combo->setCurrentIndex(combo->findData(QString::fromLatin1(data)));
  }
  QTemporaryDir folder_;
  test::Answers answers_;
  ImportForm form_;
  OpenedRecording opened_;
};

TEST_F(ImportFormTest, ProposesTheTopicsTheBoardAndAFreeFolder) {
  form_.setRecording(opened_);
  const ImportOptions options = form_.options();
  EXPECT_EQ(options.topics.image, "/camera/image_raw");
  EXPECT_EQ(options.topics.cloud, "/points");
  EXPECT_EQ(options.topics.info, "/camera/camera_info");
  EXPECT_FALSE(options.board_is_certain) << "nobody has said that it is the standard board";
  EXPECT_FALSE(options.force);
  ASSERT_TRUE(form_.target().has_value());
  EXPECT_TRUE(form_.folder().endsWith("walk-dataset"));
  EXPECT_TRUE(form_.problem().isEmpty());
  find<QLineEdit>(form_, "dataset_folder")->clear();
  EXPECT_FALSE(form_.problem().isEmpty());
}

TEST_F(ImportFormTest, ABoardIsReadFromItsFile) {
  form_.setRecording(opened_);
  Target other;
  other.tag_size_m = 0.08;
  other.circle_radius_m = 0.03;
  answers_.target = write("target.yaml", to_yaml(other));
  QSignalSpy changed(&form_, &ImportForm::boardChanged);
  choose("board", "choose");
  EXPECT_EQ(changed.size(), 1);
  ASSERT_TRUE(form_.target().has_value());
  EXPECT_EQ(form_.target()->tag_size_m, 0.08);
  EXPECT_TRUE(form_.options().board_is_certain);
  answers_.target = write("broken.yaml", "tagCols: [");
  choose("board", "choose");
  EXPECT_FALSE(form_.target().has_value());
  EXPECT_TRUE(form_.problem().contains("broken.yaml"));
  answers_.target.clear();
  choose("board", "choose");  // Cancelled: what was chosen stays.
  EXPECT_TRUE(form_.problem().contains("broken.yaml"));
  choose("board", "");
  EXPECT_TRUE(form_.problem().isEmpty());
}

TEST_F(ImportFormTest, ACameraFileStandsInForCameraInfo) {
  form_.setRecording(opened_);
  Camera camera = test::small_walk().rig.camera;
  camera.fx = 777.0;
  answers_.camera = write("camera.yaml", to_yaml(camera));
  choose("intrinsics", "choose");
  ASSERT_TRUE(form_.options().camera.has_value());
  EXPECT_EQ(form_.options().camera->fx, 777.0);
  choose("intrinsics", "/camera/camera_info");
  EXPECT_FALSE(form_.options().camera.has_value());
  EXPECT_EQ(form_.options().topics.info, "/camera/camera_info");
}

TEST_F(ImportFormTest, ABoardThatIsMadeThereIsUsed) {
  form_.setRecording(opened_);
  QSignalSpy changed(&form_, &ImportForm::boardChanged);
  choose("board", "make");
  auto* dialog = form_.findChild<TargetCameraDialog*>();
  ASSERT_NE(dialog, nullptr);
  EXPECT_EQ(find<QComboBox>(form_, "board")->currentData().toString(), "") << "until it is saved";
  find<QLineEdit>(*dialog, "tagSize")->setText("100");
  answers_.export_to = folder_.filePath("mine.yaml");
  find<QPushButton>(*dialog, "target_camera_save")->click();
  ASSERT_TRUE(form_.target().has_value()) << form_.problem().toStdString();
  EXPECT_DOUBLE_EQ(form_.target()->tag_size_m, 0.1);
  EXPECT_EQ(find<QComboBox>(form_, "board")->currentData().toString(), answers_.export_to);
  EXPECT_EQ(changed.size(), 1);
  EXPECT_TRUE(form_.options().board_is_certain);
  // Saved once more: the form has what the file has now.
  find<QLineEdit>(*dialog, "tagSize")->setText("90");
  find<QPushButton>(*dialog, "target_camera_save")->click();
  EXPECT_DOUBLE_EQ(form_.target()->tag_size_m, 0.09);
}

TEST_F(ImportFormTest, WithoutCameraInfoThereMayBeNoIntrinsicsYet) {
  opened_.candidates.infos.clear();
  opened_.info_of_images = {std::nullopt};
  form_.setRecording(opened_);
  EXPECT_EQ(find<QComboBox>(form_, "intrinsics")->currentData().toString(), "none");
  EXPECT_TRUE(form_.options().topics.info.empty());
  EXPECT_TRUE(form_.problem().isEmpty());
}

TEST_F(ImportFormTest, LimitsAreToldApartFromTopics) {
  form_.setRecording(opened_);
  QSignalSpy limits(&form_, &ImportForm::limitsChanged);
  QSignalSpy topics(&form_, &ImportForm::topicsChanged);
  find<QDoubleSpinBox>(form_, "min_still")->setValue(1.5);
  EXPECT_EQ(limits.size(), 1);
  EXPECT_EQ(topics.size(), 0);
  EXPECT_EQ(form_.options().still.min_still_s, 1.5);
}

TEST_F(ImportFormTest, AnEarlierImportIsReplacedOnlyIfAsked) {
  form_.setRecording(opened_);
  auto* replace = find<QAbstractButton>(form_, "replace_import");
  EXPECT_TRUE(replace->isHidden());
  QDir(folder_.path()).mkdir("old");
  write("old/import.json", "{}");
  find<QLineEdit>(form_, "dataset_folder")->setText(folder_.filePath("old"));
  EXPECT_FALSE(replace->isHidden());
  EXPECT_FALSE(form_.options().force);
  replace->setChecked(true);
  EXPECT_TRUE(form_.options().force);
}

}  // namespace
}  // namespace lvcalib::widgets::import_form_test
