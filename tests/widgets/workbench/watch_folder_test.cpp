// SPDX-License-Identifier: GPL-3.0-or-later
// A folder that is watched, through the menus of the window.
#include <QDialog>
#include <QDir>
#include <QFile>
#include <QLineEdit>
#include <QPushButton>

#include "docks/scenes_dock.h"
#include "importing/files_dialog.h"
#include "tools/watch_window.h"
#include "widgets/workbench/main_window_fixture.h"

namespace lvcalib::watch_folder_test {
namespace {

using test::find;
using test::trigger;
using test::wait_until;

class WatchFolderTest : public test::MainWindowTest {
 protected:
  // Scenes of the shared dataset in one of its own; the last stays away.
  void SetUp() override {
    test::MainWindowTest::SetUp();
    ASSERT_TRUE(QDir(folder_.path()).mkpath("rig/scenes"));
    for (const char* name : {"target.yaml", "camera.yaml"})
      ASSERT_TRUE(QFile::copy(dataset() + '/' + name, rig(name)));
    for (const char* scene : {"A", "B"}) add(scene);
  }
  QString rig(const QString& file) const { return folder_.filePath("rig/" + file); }
  void add(const QString& scene) {
    ASSERT_TRUE(QDir(rig("scenes")).mkpath(scene));
    for (const char* name : {"image.png", "cloud.pcd"}) {
      const QString file = QStringLiteral("scenes/%1/%2").arg(scene, name);
      ASSERT_TRUE(QFile::copy(dataset() + '/' + file, rig(file)));
    }
  }
  void pair(const QString& scene, const QString& name) {
    ASSERT_TRUE(QDir(folder_.path()).mkpath("out"));
    const QString from = dataset() + "/scenes/" + scene;
    ASSERT_TRUE(QFile::copy(from + "/image.png", folder_.filePath("out/" + name + ".png")));
    ASSERT_TRUE(QFile::copy(from + "/cloud.pcd", folder_.filePath("out/" + name + ".pcd")));
  }
  bool checked(const char* name) { return find<QAction>(*window_, name)->isChecked(); }
  bool solved(std::size_t scenes) {
    return wait_until([&] {
      return !workspace().busy() && workspace().up_to_date() && workspace().result() &&
             workspace().result()->scenes.size() == scenes;
    });
  }
};

TEST_F(WatchFolderTest, ThisFolderIsWatchedUntilTheSameActionEndsIt) {
  EXPECT_FALSE(trigger(*window_, "watch_dataset"));
  window_->open(rig(""));
  ASSERT_TRUE(wait_until([&] { return workspace().is_open() && !workspace().busy(); }));
  QTest::keyClick(window_.get(), Qt::Key_F5);
  ASSERT_TRUE(solved(2));
  test::click_scene(*window_, "B", false);
  ASSERT_TRUE(trigger(*window_, "watch_dataset"));
  EXPECT_TRUE(checked("watch_dataset"));
  auto* watched = window_->findChild<widgets::WatchWindow*>();
  ASSERT_NE(watched, nullptr);
  EXPECT_TRUE(watched->isVisible());
  add("C");
  ASSERT_TRUE(solved(3));
  EXPECT_EQ(test::cell(*window_, "C", 0), "C");
  // The scene that was looked at still is.
  EXPECT_EQ(find<QTreeView>(*window_, "scenes")->currentIndex().siblingAtColumn(0).data(), "B");
  ASSERT_TRUE(wait_until([&] { return watched->nextPose().has_value(); }, 60'000));
  // Closed, it comes back by the menu.
  watched->close();
  ASSERT_TRUE(trigger(*window_, "what_next"));
  ASSERT_TRUE(trigger(*window_, "watch_dataset"));
  EXPECT_FALSE(checked("watch_dataset"));
  EXPECT_FALSE(window_->watch_work().watching());
  EXPECT_FALSE(find<QAction>(*window_, "what_next")->isEnabled());
}

TEST_F(WatchFolderTest, AFolderOfFilesMakesADatasetThatGrows) {
  pair("A", "pose1");
  pair("B", "pose2");
  answers_.files = folder_.filePath("out");
  answers_.camera = dataset() + "/camera.yaml";
  ASSERT_TRUE(trigger(*window_, "watch_files"));
  EXPECT_FALSE(checked("watch_files"));
  auto* dialog = window_->findChild<widgets::FilesDialog*>();
  ASSERT_NE(dialog, nullptr);
  find<QLineEdit>(*dialog, "files_dataset")->setText(folder_.filePath("made"));
  ASSERT_TRUE(wait_until([&] { return !dialog->busy(); }));
  auto* cameras = find<QComboBox>(*dialog, "files_camera");
  cameras->setCurrentIndex(cameras->findData("choose"));
  auto* import = find<QPushButton>(*dialog, "import_start");
  ASSERT_TRUE(wait_until([&] { return import->isEnabled(); }, 20'000));
  import->click();
  ASSERT_TRUE(wait_until([&] { return window_->watch_work().watchingFiles(); }));
  EXPECT_TRUE(checked("watch_files"));
  ASSERT_TRUE(solved(2));
  pair("C", "pose3");
  ASSERT_TRUE(solved(3));
  EXPECT_TRUE(QFile::exists(folder_.filePath("made/scenes/pose3/cloud.pcd")));
  ASSERT_TRUE(trigger(*window_, "watch_files"));
  EXPECT_FALSE(window_->watch_work().watching());
}

TEST_F(WatchFolderTest, FilesGoIntoTheDatasetThatIsOpen) {
  window_->open(rig(""));
  ASSERT_TRUE(wait_until([&] { return workspace().is_open() && !workspace().busy(); }));
  pair("C", "pose3");
  answers_.files = QString();
  ASSERT_TRUE(trigger(*window_, "watch_files"));
  EXPECT_FALSE(window_->watch_work().watching());
  answers_.files = folder_.filePath("out");
  ASSERT_TRUE(trigger(*window_, "watch_files"));
  ASSERT_TRUE(solved(3));
  EXPECT_TRUE(QFile::exists(rig("scenes/pose3/image.png")));
  // Another dataset ends it.
  window_->open(dataset());
  ASSERT_TRUE(wait_until([&] { return !window_->watch_work().watching(); }));
  EXPECT_FALSE(checked("watch_files"));
}

}  // namespace
}  // namespace lvcalib::watch_folder_test
