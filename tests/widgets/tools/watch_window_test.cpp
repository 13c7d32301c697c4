// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/watch_window.h"

#include <QDir>
#include <QFile>
#include <QImage>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include "runner/workspace.h"
#include "tools/plan_text.h"
#include "views/board_sketch.h"
#include "views/large_text.h"
#include "widgets/workbench/main_window_fixture.h"

namespace lvcalib::widgets::watch_window_test {
namespace {

using test::find;
using test::wait_until;

// Three scenes that are solved; the fourth lies aside and comes while the folder is watched.
class WatchWindowTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    source_ = new QTemporaryDir;
    simulation::SimulationOptions options = test::small_demo();
    options.scenes = 4;
    options.lidar.points = 60'000;
    ASSERT_TRUE(make_demo(source_->filePath("all").toStdString(), options, {}).ok());
  }
  static void TearDownTestSuite() {
    EXPECT_TRUE(Runner::wait_for_workers(60'000));
    delete source_;
  }
  static QString from(const QString& file) { return source_->filePath("all/" + file); }
  static QString late(const char* file) { return from(QStringLiteral("scenes/D/") + file); }

  void SetUp() override {
    for (const char* scene : {"A", "B", "C"}) {
      ASSERT_TRUE(QDir(folder_.path()).mkpath(QStringLiteral("rig/scenes/") + scene));
      for (const char* name : {"image.png", "cloud.pcd"}) {
        const QString file = QStringLiteral("scenes/%1/%2").arg(scene, name);
        ASSERT_TRUE(QFile::copy(from(file), rig(file)));
      }
    }
    for (const char* name : {"target.yaml", "camera.yaml"})
      ASSERT_TRUE(QFile::copy(from(name), rig(name)));
    workspace_ = std::make_unique<Workspace>(folder_.filePath("data"));
    watch_ = std::make_unique<WatchWork>(*workspace_);
    QSignalSpy opened(workspace_.get(), &Workspace::opened);
    workspace_->open_dataset(rig(""));
    ASSERT_TRUE(opened.wait(10'000));
    ASSERT_TRUE(wait_until([&] { return !workspace_->busy(); }));
  }
  void TearDown() override {
    window_.reset();
    watch_.reset();
    workspace_.reset();
  }
  QString rig(const QString& file) const { return folder_.filePath("rig/" + file); }
  void run() {
    workspace_->run();
    ASSERT_TRUE(wait_until([&] { return solved(3); }));
  }
  void show() {
    window_ = std::make_unique<WatchWindow>(*workspace_, *watch_);
    window_->setAttribute(Qt::WA_DeleteOnClose, false);
    window_->resize(1240, 660);
    window_->show();
  }
  bool solved(std::size_t scenes) {
    return !workspace_->busy() && workspace_->result() && workspace_->up_to_date() &&
           workspace_->result()->scenes.size() == scenes;
  }
  bool has_next() {
    return wait_until([&] { return !window_->busy() && window_->nextPose().has_value(); }, 60'000);
  }
  QString said(const char* name) { return find<LargeText>(*window_, name)->text(); }
  QString pending() { return find<QLabel>(*window_, "watch_pending")->text(); }

  static inline QTemporaryDir* source_ = nullptr;
  QTemporaryDir folder_;
  std::unique_ptr<Workspace> workspace_;
  std::unique_ptr<WatchWork> watch_;
  std::unique_ptr<WatchWindow> window_;
};

TEST_F(WatchWindowTest, ANewSceneIsSolvedAndTheNextPoseIsNamed) {
  run();
  show();
  ASSERT_TRUE(has_next());
  EXPECT_TRUE(said("watch_scenes").contains("3"));
  const double sigma = sigma_mm(workspace_->result()->covariance_total);
  EXPECT_TRUE(said("watch_sigma").contains(sigma_text(sigma))) << said("watch_sigma").toStdString();
  watch_->watchScenes();
  EXPECT_TRUE(pending().contains("scenes"));
  // The image comes first, and half of the cloud.
  ASSERT_TRUE(QDir(rig("scenes")).mkpath("D"));
  ASSERT_TRUE(QFile::copy(late("image.png"), rig("scenes/D/image.png")));
  ASSERT_TRUE(wait_until([&] { return pending().contains("no cloud in this scene"); }, 10'000))
      << pending().toStdString();
  QFile cloud(late("cloud.pcd"));
  ASSERT_TRUE(cloud.open(QIODevice::ReadOnly));
  const QByteArray bytes = cloud.readAll();
  QFile grown(rig("scenes/D/cloud.pcd"));
  ASSERT_TRUE(grown.open(QIODevice::WriteOnly | QIODevice::Unbuffered));
  grown.write(bytes.left(bytes.size() / 2));
  ASSERT_TRUE(wait_until([&] { return pending().contains("cannot be read yet"); }, 10'000))
      << pending().toStdString();
  EXPECT_TRUE(pending().startsWith("D ")) << pending().toStdString();
  EXPECT_EQ(workspace_->dataset().scenes.size(), 3U);
  QSignalSpy arrived(watch_.get(), &WatchWork::arrived);
  grown.write(bytes.mid(bytes.size() / 2));
  grown.close();
  ASSERT_TRUE(arrived.wait(10'000));
  EXPECT_TRUE(said("watch_last").contains("being solved"));
  EXPECT_FALSE(window_->nextPose().has_value());
  ASSERT_TRUE(wait_until([&] { return solved(4); }));
  ASSERT_TRUE(has_next());
  EXPECT_EQ(said("watch_last"), "D is taken");
  EXPECT_EQ(said("watch_scenes"), "Scenes: 4");
  EXPECT_EQ(workspace_->undo_stack().count(), 0);
  EXPECT_FALSE(workspace_->dirty());
  for (const QString& part : board_place_parts(*window_->nextPose()))
    EXPECT_TRUE(said("watch_next").contains(part)) << part.toStdString();
  EXPECT_FALSE(window_->findChild<BoardSketch*>()->outline().isEmpty());
  const double after = sigma_mm(workspace_->result()->covariance_total);
  EXPECT_LT(after, sigma);
  EXPECT_TRUE(said("watch_sigma").contains(sigma_text(after)));
  // To be read from two metres away.
  EXPECT_GE(find<LargeText>(*window_, "watch_next")->points(), 40.0);
  EXPECT_GE(find<LargeText>(*window_, "watch_sigma")->points(), 40.0);
  EXPECT_GE(find<LargeText>(*window_, "watch_last")->points(), 40.0);
}

TEST_F(WatchWindowTest, WhyASceneWasNotTakenIsSaid) {
  run();
  show();
  watch_->watchScenes();
  ASSERT_TRUE(QDir(rig("scenes")).mkpath("D"));
  QImage grey(QImage(late("image.png")).size(), QImage::Format_Grayscale8);
  grey.fill(90);
  ASSERT_TRUE(grey.save(rig("scenes/D/image.png")));
  ASSERT_TRUE(QFile::copy(late("cloud.pcd"), rig("scenes/D/cloud.pcd")));
  ASSERT_TRUE(wait_until([&] { return solved(4); }));
  ASSERT_TRUE(has_next());
  EXPECT_TRUE(said("watch_last").startsWith("D not taken: no tags in the image"))
      << said("watch_last").toStdString();
  EXPECT_EQ(said("watch_scenes"), "Scenes: 3/4");
}

TEST_F(WatchWindowTest, ACancelledRunIsNotWaitedFor) {
  run();
  show();
  watch_->watchScenes();
  QSignalSpy arrived(watch_.get(), &WatchWork::arrived);
  ASSERT_TRUE(QDir(rig("scenes")).mkpath("D"));
  for (const char* name : {"image.png", "cloud.pcd"})
    ASSERT_TRUE(QFile::copy(late(name), rig(QStringLiteral("scenes/D/") + name)));
  ASSERT_TRUE(arrived.wait(10'000));
  workspace_->cancel();
  ASSERT_TRUE(wait_until([&] { return !workspace_->busy(); }, 10'000));
  EXPECT_EQ(said("watch_last"), "Waiting for the next scene");
  EXPECT_EQ(said("watch_scenes"), "Scenes: 3/4");
  workspace_->run();
  ASSERT_TRUE(wait_until([&] { return solved(4); }));
  EXPECT_EQ(said("watch_scenes"), "Scenes: 4");
}

TEST_F(WatchWindowTest, WithoutAResultThePlainestPoseIsShown) {
  show();
  EXPECT_EQ(said("watch_sigma"), "No result yet");
  EXPECT_TRUE(said("watch_next").contains("two metres ahead"));
  EXPECT_FALSE(window_->findChild<BoardSketch*>()->outline().isEmpty());
  EXPECT_FALSE(find<QPushButton>(*window_, "watch_stop")->isEnabled());
  watch_->watchScenes();
  EXPECT_TRUE(find<QPushButton>(*window_, "watch_stop")->isEnabled());
  EXPECT_EQ(said("watch_last"), "Waiting for the next scene");
  find<QPushButton>(*window_, "watch_stop")->click();
  EXPECT_FALSE(watch_->watching());
  EXPECT_EQ(pending(), "Watching has ended");
}

TEST_F(WatchWindowTest, FilesOfAnotherProgramBecomeScenes) {
  run();
  show();
  const QString out = folder_.filePath("out");
  ASSERT_TRUE(QDir().mkpath(out));
  PairOptions options;
  options.images = out.toStdString();
  watch_->watchFiles(options, {"old"});
  EXPECT_TRUE(watch_->watchingFiles());
  const auto copy = [&](const QString& name, const QImage& image) {
    ASSERT_TRUE(image.save(out + '/' + name + ".png"));
    ASSERT_TRUE(QFile::copy(late("cloud.pcd"), out + '/' + name + ".pcd"));
  };
  const QImage image(late("image.png"));
  copy("old", image);
  copy("small", image.scaled(400, 250));
  ASSERT_TRUE(wait_until([&] { return said("watch_last").startsWith("small not taken"); }, 20'000))
      << pending().toStdString();
  EXPECT_TRUE(said("watch_last").contains("400"));
  copy("pose4", image);
  ASSERT_TRUE(wait_until([&] { return solved(4); })) << pending().toStdString();
  EXPECT_EQ(workspace_->dataset().scenes.back().name, "pose4");
  EXPECT_EQ(workspace_->dataset().scenes.back().image.parent_path(),
            std::filesystem::path(rig("scenes/pose4").toStdString()));
  ASSERT_TRUE(has_next());
  EXPECT_EQ(said("watch_last"), "pose4 is taken");
  // A folder that goes away is said, and may come back.
  QSignalSpy failed(watch_.get(), &WatchWork::failed);
  ASSERT_TRUE(QDir().rename(out, out + "-away"));
  ASSERT_TRUE(failed.wait(10'000));
  EXPECT_TRUE(pending().contains("folder not found")) << pending().toStdString();
  ASSERT_TRUE(QDir().rename(out + "-away", out));
  EXPECT_TRUE(wait_until([&] { return !pending().contains("folder not found"); }, 10'000));
}

TEST_F(WatchWindowTest, AnotherDatasetEndsTheWatch) {
  watch_->watchScenes();
  EXPECT_TRUE(watch_->watching());
  workspace_->open_dataset(rig(""));
  ASSERT_TRUE(wait_until([&] { return !workspace_->busy(); }));
  EXPECT_TRUE(watch_->watching());  // The same one.
  workspace_->open_dataset(from(""));
  ASSERT_TRUE(wait_until([&] { return workspace_->dataset().scenes.size() == 4; }));
  EXPECT_TRUE(wait_until([&] { return !watch_->watching(); }, 5'000));
}

TEST_F(WatchWindowTest, FullScreenIsLeftByTheSameKeys) {
  show();
  auto* full = find<QPushButton>(*window_, "watch_full_screen");
  full->click();
  EXPECT_TRUE(window_->isFullScreen());
  QTest::keyClick(window_.get(), Qt::Key_Escape);
  EXPECT_FALSE(window_->isFullScreen());
  EXPECT_FALSE(full->isChecked());
}

}  // namespace
}  // namespace lvcalib::widgets::watch_window_test
