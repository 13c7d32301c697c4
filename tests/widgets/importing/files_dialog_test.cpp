// SPDX-License-Identifier: GPL-3.0-or-later
// From folders of images and clouds to an extrinsic through the window.
#include "importing/files_dialog.h"

#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFile>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QTreeWidget>

#include <gtest/gtest.h>

#include "base/file_io.h"
#include "camera/camera.h"
#include "runner/demo.h"
#include "widgets/workbench/main_window_fixture.h"

namespace lvcalib::widgets::files_dialog_test {
namespace {

using test::find;
using test::wait_until;

class FilesDialogTest : public ::testing::Test {
 protected:
  static void TearDownTestSuite() { EXPECT_TRUE(Runner::wait_for_workers(60'000)); }
  void SetUp() override {
    settings_ = std::make_unique<AppSettings>(folder_.filePath("settings"));
    window_ = std::make_unique<MainWindow>(*settings_, answers_);
    window_->show();
    // A simulated dataset's files, as somebody else would keep them.
    const QString source = folder_.filePath("source");
    ASSERT_TRUE(make_demo(source.toStdString(), test::small_demo(), {}).ok());
    QDir(folder_.path()).mkpath("rig/images");
    QDir(folder_.path()).mkpath("rig/clouds");
    for (const QString& scene :
         QDir(source + "/scenes").entryList(QDir::Dirs | QDir::NoDotAndDotDot)) {
      ++scenes_;
      QFile::copy(source + "/scenes/" + scene + "/image.png", file("images/" + scene + ".png"));
      QFile::copy(source + "/scenes/" + scene + "/cloud.pcd", file("clouds/" + scene + ".pcd"));
    }
    camera_ = source + "/camera.yaml";
    ASSERT_GE(scenes_, 2);
  }
  [[nodiscard]] QString file(const QString& name) const { return folder_.filePath("rig/" + name); }
  void open(const QString& folder) {
    answers_.files = folder;
    ASSERT_TRUE(test::trigger(*window_, "import_files"));
    ASSERT_NE(dialog(), nullptr);
    find<QLineEdit>(*dialog(), "files_dataset")->setText(folder_.filePath("made"));
    ASSERT_TRUE(wait_until([&] { return !dialog()->busy(); }));
  }
  FilesDialog* dialog() { return window_->findChild<FilesDialog*>(); }
  QTreeWidget& pairs() { return *find<QTreeWidget>(*dialog(), "pairs"); }
  QPushButton& button(const char* name) { return *find<QPushButton>(*dialog(), name); }
  QString text(const char* name) { return find<QLabel>(*dialog(), name)->text(); }
  bool wait_for_boards() {
    return wait_until([&] {
      for (int i = 0; i < pairs().topLevelItemCount(); ++i) {
        if (pairs().topLevelItem(i)->text(4).isEmpty()) return false;
      }
      return true;
    });
  }

  QTemporaryDir folder_;
  test::Answers answers_;
  std::unique_ptr<AppSettings> settings_;
  std::unique_ptr<MainWindow> window_;
  QString camera_;
  int scenes_ = 0;
};

TEST_F(FilesDialogTest, FromFoldersToAnExtrinsic) {
  QFile::copy(camera_, file("camera.yaml"));
  open(folder_.filePath("rig"));
  ASSERT_EQ(pairs().topLevelItemCount(), scenes_);
  EXPECT_TRUE(text("files_layout").contains("names"));
  EXPECT_TRUE(find<QComboBox>(*dialog(), "files_camera")->currentText().endsWith("camera.yaml"));
  ASSERT_TRUE(wait_for_boards());
  EXPECT_EQ(pairs().topLevelItem(0)->text(4), "seen");
  EXPECT_FALSE(pairs().topLevelItem(0)->icon(0).isNull());
  pairs().topLevelItem(0)->setCheckState(0, Qt::Unchecked);
  EXPECT_TRUE(text("import_count").startsWith(QString::number(scenes_ - 1)));
  pairs().topLevelItem(0)->setCheckState(0, Qt::Checked);
  button("import_start").click();
  ASSERT_TRUE(wait_until([&] { return dialog() == nullptr; }));
  ASSERT_TRUE(test::wait_for_result(*window_));
  EXPECT_EQ(window_->workspace().result()->scenes.size(), static_cast<std::size_t>(scenes_));
}

TEST_F(FilesDialogTest, WhatIsUntickedIsNoScene) {
  QFile::copy(camera_, file("camera.yaml"));
  open(folder_.filePath("rig"));
  for (int i = 1; i < scenes_; ++i) pairs().topLevelItem(i)->setCheckState(0, Qt::Unchecked);
  button("import_start").click();
  ASSERT_TRUE(wait_until([&] { return window_->workspace().is_open(); }));
  EXPECT_EQ(window_->workspace().dataset().scenes.size(), 1U);
  window_->workspace().cancel();
}

TEST_F(FilesDialogTest, WithoutIntrinsicsTheyCanBeChosen) {
  open(folder_.filePath("rig"));
  ASSERT_EQ(pairs().topLevelItemCount(), scenes_);
  auto* cameras = find<QComboBox>(*dialog(), "files_camera");
  EXPECT_EQ(cameras->currentData().toString(), "none");
  EXPECT_TRUE(pairs().topLevelItem(0)->text(4).isEmpty()) << "nobody can look for the board";
  answers_.camera = folder_.filePath("nothing.yaml");
  cameras->setCurrentIndex(cameras->findData("choose"));
  EXPECT_TRUE(text("import_problem").contains("nothing.yaml"));
  answers_.camera = camera_;
  cameras->setCurrentIndex(cameras->findData("choose"));
  EXPECT_EQ(cameras->currentData().toString(), "file:");
  EXPECT_TRUE(text("import_problem").isEmpty()) << text("import_problem").toStdString();
  ASSERT_TRUE(wait_for_boards());
  cameras->setCurrentIndex(cameras->findData("none"));
  button("import_start").click();
  ASSERT_TRUE(wait_until([&] { return !dialog()->busy(); }));
  EXPECT_TRUE(text("import_problem").contains("without intrinsics"));
  EXPECT_TRUE(QFile::exists(folder_.filePath("made/target.yaml")));
  EXPECT_FALSE(window_->workspace().is_open());
}

TEST_F(FilesDialogTest, AnotherRuleLooksAgainAndErrorsAreOneMessage) {
  open(folder_.filePath("rig"));
  ASSERT_GT(pairs().topLevelItemCount(), 0);
  auto* rule = find<QComboBox>(*dialog(), "pair_rule");
  rule->setCurrentIndex(2);
  ASSERT_TRUE(wait_until([&] { return !dialog()->busy() && !text("import_problem").isEmpty(); }));
  EXPECT_TRUE(text("import_problem").contains("no times")) << text("import_problem").toStdString();
  EXPECT_EQ(pairs().topLevelItemCount(), 0);
  EXPECT_FALSE(button("import_start").isEnabled());
  rule->setCurrentIndex(1);
  ASSERT_TRUE(wait_until([&] { return pairs().topLevelItemCount() == scenes_; }));
  EXPECT_TRUE(button("import_start").isEnabled());
}

TEST_F(FilesDialogTest, AFolderOfPairsThatIsDroppedOrOpenedComesHere) {
  answers_.dataset = folder_.filePath("rig");
  ASSERT_TRUE(test::trigger(*window_, "open_dataset"));
  ASSERT_NE(dialog(), nullptr);
  EXPECT_TRUE(wait_until([&] { return pairs().topLevelItemCount() == scenes_; }));
  dialog()->close();
  EXPECT_TRUE(wait_until([&] { return dialog() == nullptr; }, 5000));
}

}  // namespace
}  // namespace lvcalib::widgets::files_dialog_test
