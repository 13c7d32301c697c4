// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/watch_work.h"

#include <QDir>
#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include "runner/demo.h"
#include "runner/workspace.h"

namespace lvcalib::widgets::watch_work_test {
namespace {

// A tiny dataset, too small to be solved; its last scene lies aside.
class WatchWorkTest : public ::testing::Test {
 protected:
  static void TearDownTestSuite() { EXPECT_TRUE(Runner::wait_for_workers(60'000)); }
  void SetUp() override {
    simulation::SimulationOptions options;
    options.scenes = 3;
    options.lidar.points = 2000;
    options.image.width_px = 320;
    options.image.height_px = 240;
    ASSERT_TRUE(make_demo(path("d").toStdString(), options, {}).ok());
    ASSERT_TRUE(QDir().rename(path("d/scenes/C"), path("aside")));
    QSignalSpy opened(&workspace_, &Workspace::opened);
    workspace_.open_dataset(path("d"));
    ASSERT_TRUE(opened.wait(5000));
  }
  [[nodiscard]] QString path(const QString& name) const { return folder_.filePath(name); }
  [[nodiscard]] std::vector<std::string> scenes() const {
    std::vector<std::string> out;
    for (const SceneFiles& files : workspace_.dataset().scenes) out.push_back(files.name);
    return out;
  }

  QTemporaryDir folder_;
  Workspace workspace_{folder_.filePath("data")};
  WatchWork watch_{workspace_};
};

TEST_F(WatchWorkTest, ANewFolderIsHandedToTheWorkspace) {
  QSignalSpy changed(&watch_, &WatchWork::changed);
  QSignalSpy arrived(&watch_, &WatchWork::arrived);
  QSignalSpy appeared(&workspace_, &Workspace::scenes_appeared);
  QSignalSpy ended(&workspace_, &Workspace::run_ended);
  watch_.watchScenes();
  EXPECT_TRUE(watch_.watching());
  EXPECT_FALSE(watch_.watchingFiles());
  EXPECT_EQ(changed.count(), 1);
  ASSERT_TRUE(QDir().rename(path("aside"), path("d/scenes/C")));
  ASSERT_TRUE(arrived.wait(10'000));
  EXPECT_EQ(arrived.first().first().toStringList(), QStringList{"C"});
  EXPECT_EQ(appeared.count(), 1);
  EXPECT_EQ(scenes(), (std::vector<std::string>{"A", "B", "C"}));
  EXPECT_TRUE(watch_.ranLast());
  EXPECT_TRUE(ended.count() > 0 || ended.wait(60'000));
  EXPECT_TRUE(watch_.pending().empty());
  watch_.stop();
  EXPECT_EQ(changed.count(), 2);
  workspace_.run();
  EXPECT_FALSE(watch_.ranLast());
  workspace_.cancel();
}

// Its folder was there when the dataset was opened, without its cloud.
TEST_F(WatchWorkTest, ASceneThatWasIncompleteIsCompleted) {
  ASSERT_TRUE(QDir(path("d/scenes")).mkpath("C"));
  ASSERT_TRUE(QFile::copy(path("aside/image.png"), path("d/scenes/C/image.png")));
  QSignalSpy opened(&workspace_, &Workspace::opened);
  workspace_.open_dataset(path("d"));
  ASSERT_TRUE(opened.wait(5000));
  ASSERT_EQ(scenes().size(), 3U);
  ASSERT_TRUE(workspace_.dataset().scenes[2].problem.has_value());
  QSignalSpy arrived(&watch_, &WatchWork::arrived);
  QSignalSpy looked(&watch_, &WatchWork::looked);
  watch_.watchScenes();
  ASSERT_TRUE(looked.wait(10'000));
  ASSERT_EQ(watch_.pending().size(), 1U);
  EXPECT_EQ(watch_.pending().front().name, "C");
  ASSERT_TRUE(QFile::copy(path("aside/cloud.pcd"), path("d/scenes/C/cloud.pcd")));
  ASSERT_TRUE(arrived.wait(10'000));
  ASSERT_EQ(scenes().size(), 3U);
  EXPECT_FALSE(workspace_.dataset().scenes[2].problem.has_value());
  workspace_.cancel();
}

TEST_F(WatchWorkTest, ATroubledFolderIsToldOnceAndLookedAtAgain) {
  QSignalSpy failed(&watch_, &WatchWork::failed);
  QSignalSpy looked(&watch_, &WatchWork::looked);
  ASSERT_TRUE(QDir().rename(path("d/scenes"), path("away")));
  watch_.watchScenes();
  ASSERT_TRUE(looked.wait(10'000));
  ASSERT_TRUE(looked.wait(10'000));
  EXPECT_EQ(failed.count(), 1);
  EXPECT_EQ(watch_.pending().size(), 1U);
  ASSERT_TRUE(QDir().rename(path("away"), path("d/scenes")));
  ASSERT_TRUE(looked.wait(10'000));
  EXPECT_TRUE(watch_.pending().empty());
}

TEST_F(WatchWorkTest, NothingIsWatchedWithoutADataset) {
  Workspace empty(path("other"));
  WatchWork watch(empty);
  watch.watchScenes();
  EXPECT_FALSE(watch.watching());
  watch.watchFiles({}, {});
  EXPECT_FALSE(watch.watching());
  EXPECT_FALSE(empty.take_new_scenes({"/nowhere/X"}).ok());
}

}  // namespace
}  // namespace lvcalib::widgets::watch_work_test
