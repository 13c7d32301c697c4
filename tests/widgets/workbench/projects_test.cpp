// SPDX-License-Identifier: GPL-3.0-or-later
#include <QDialog>
#include <QDir>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QProcess>
#include <QTemporaryDir>
#include <filesystem>
#include <functional>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file_io.h"
#include "runner/demo.h"
#include "widgets/support/driver.h"

namespace lvcalib::projects_test {
namespace {

using test::cell;
using test::find;
using test::trigger;
using test::wait_until;
using widgets::Autosave;
using widgets::MainWindow;
using widgets::SceneModel;

// Projects of one small dataset; nothing is run.
class ProjectsTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    data_ = new QTemporaryDir;
    simulation::SimulationOptions options;
    options.seed = 4;
    options.lidar.points = 20'000;
    options.image.width_px = 640;
    options.image.height_px = 400;
    ASSERT_TRUE(widgets::make_demo(dataset().toStdString(), options, {}).ok());
  }
  static void TearDownTestSuite() { delete data_; }
  static QString dataset() { return data_->filePath(QStringLiteral("dataset")); }

  void SetUp() override { make_window(); }
  void make_window() {
    window_.reset();
    settings_ = std::make_unique<widgets::AppSettings>(folder_.path());
    window_ = std::make_unique<MainWindow>(*settings_, answers_);
    window_->show();
  }
  void open(const QString& path) {
    window_->open(path);
    ASSERT_TRUE(wait_until([&] { return !window_->workspace().busy(); }));
    QTest::qWait(20);
  }
  QString path(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }

  static inline QTemporaryDir* data_ = nullptr;
  QTemporaryDir folder_;
  test::Answers answers_;
  std::unique_ptr<widgets::AppSettings> settings_;
  std::unique_ptr<MainWindow> window_;
};

TEST_F(ProjectsTest, SavedDecisionsAreThereAgainAfterReopening) {
  open(dataset());
  test::click_scene(*window_, "B", true);
  find<QDoubleSpinBox>(*window_, "refinement.max_bins")->setValue(30);
  CropBox box;
  box.center_m = {1, 2, 3};
  window_->workspace().set_crop("C", box);
  EXPECT_TRUE(window_->isWindowModified());
  answers_.save_as = path("p.lvcalib");
  ASSERT_TRUE(trigger(*window_, "save"));
  EXPECT_FALSE(window_->isWindowModified());
  EXPECT_TRUE(QFile::exists(path("p.lvcalib")));
  make_window();
  open(path("p.lvcalib"));
  EXPECT_EQ(cell(*window_, "B", SceneModel::kState), "rejected");
  EXPECT_EQ(find<QDoubleSpinBox>(*window_, "refinement.max_bins")->value(), 30);
  EXPECT_EQ(decision_of(window_->workspace().decisions(), "C").crop, box);
  EXPECT_FALSE(window_->workspace().dirty());
  EXPECT_EQ(answers_.asked_unsaved, 0);
  EXPECT_EQ(settings_->recent().first(), path("p.lvcalib"));
}

TEST_F(ProjectsTest, UnsavedDecisionsAreAskedAboutBeforeClosing) {
  open(dataset());
  test::click_scene(*window_, "A", true);
  answers_.unsaved_answer = widgets::UnsavedAnswer::kCancel;
  EXPECT_FALSE(window_->close());
  answers_.unsaved_answer = widgets::UnsavedAnswer::kSave;
  answers_.save_as = path("q.lvcalib");
  EXPECT_TRUE(window_->close());
  EXPECT_EQ(answers_.asked_unsaved, 2);
  EXPECT_TRUE(QFile::exists(path("q.lvcalib")));
}

TEST_F(ProjectsTest, AMovedDatasetIsAskedFor) {
  ASSERT_TRUE(
      write_project(path("p.lvcalib").toStdString(), {dataset().toStdString() + "-old", {}, {}})
          .ok());
  open(path("p.lvcalib"));
  EXPECT_EQ(answers_.asked_moved, 1);
  EXPECT_FALSE(window_->workspace().is_open());
  answers_.moved_to = dataset();
  open(path("p.lvcalib"));
  EXPECT_EQ(answers_.asked_moved, 2);
  ASSERT_TRUE(window_->workspace().is_open());
  EXPECT_TRUE(window_->workspace().dirty());
}

TEST_F(ProjectsTest, MissingScenesAreMarkedAndTheRestIsUsable) {
  Project project{dataset().toStdString(), {}, {}};
  project.decisions.scenes["Z"].use = true;
  ASSERT_TRUE(write_project(path("p.lvcalib").toStdString(), project).ok());
  open(path("p.lvcalib"));
  EXPECT_EQ(cell(*window_, "Z", SceneModel::kState), "missing on disk");
  EXPECT_EQ(cell(*window_, "A", SceneModel::kState), "not run");
  test::click_scene(*window_, "Z", true);
  EXPECT_FALSE(window_->workspace().dirty());
  EXPECT_EQ(
      request_of(window_->workspace().dataset(), window_->workspace().decisions()).rejected.size(),
      0U);
}

TEST_F(ProjectsTest, ANewerProjectIsRefusedInADialogAndLeftAlone) {
  const std::string text = "format: lvcalib-project\nversion: 99\ndataset: x\n";
  ASSERT_TRUE(write_file_atomically(path("p.lvcalib").toStdString(), text).ok());
  open(path("p.lvcalib"));
  auto* dialog = find<QDialog>(*window_, "error_dialog");
  ASSERT_NE(dialog, nullptr);
  QString said;
  for (const QLabel* label : dialog->findChildren<QLabel*>()) said += label->text();
  EXPECT_TRUE(said.contains("99") && said.contains("p.lvcalib")) << said.toStdString();
  EXPECT_EQ(*read_text_file(path("p.lvcalib").toStdString(), 1000), text);
}

TEST_F(ProjectsTest, ScenesFromElsewhereJoinAndCanBeUndone) {
  open(dataset());
  namespace fs = std::filesystem;
  fs::copy((dataset() + "/scenes/A").toStdString(), path("X").toStdString());
  answers_.scenes = {path("X")};
  ASSERT_TRUE(trigger(*window_, "add_scenes"));
  EXPECT_EQ(cell(*window_, "X", SceneModel::kState), "not run");
  ASSERT_TRUE(trigger(*window_, "add_scenes"));  // Its name is taken now.
  EXPECT_NE(find<QDialog>(*window_, "error_dialog"), nullptr);
  window_->workspace().undo_stack().undo();
  EXPECT_EQ(cell(*window_, "X", SceneModel::kState), "");
  EXPECT_EQ(window_->workspace().dataset().scenes.size(), 3U);
}

// The program itself is started, changed by its own autosave, and killed.
// Two rigs have names of their own; what was said last is only offered to a rig without any.
TEST_F(ProjectsTest, EveryProjectBringsTheNamesOfItsFrames) {
  using Names = std::pair<QString, QString>;
  const auto with_results = [&](const std::function<void(QWidget&)>& look) {
    if (!window_->workspace().result()) ASSERT_TRUE(trigger(*window_, "run"));
    ASSERT_TRUE(test::wait_for_result(*window_));
    ASSERT_TRUE(trigger(*window_, "results"));
    auto* dialog = find<QDialog>(*window_, "results_dialog");
    ASSERT_NE(dialog, nullptr);
    look(*dialog);
    delete dialog;
  };
  const auto names = [&] {
    Names out;
    with_results([&](QWidget& dialog) {
      out = {find<QLineEdit>(dialog, "lidar_frame")->text(),
             find<QLineEdit>(dialog, "camera_frame")->text()};
    });
    return out;
  };
  const auto call = [&](const char* lidar) {
    with_results([&](QWidget& dialog) {
      auto* field = find<QLineEdit>(dialog, "lidar_frame");
      field->selectAll();
      QTest::keyClicks(field, QString::fromLatin1(lidar));
    });
  };
  const auto save = [&](const char* name) {
    answers_.save_as = path(name);
    ASSERT_TRUE(trigger(*window_, "save_as"));
    EXPECT_FALSE(window_->workspace().dirty());
  };
  open(dataset());
  EXPECT_EQ(names(), Names("lidar", "camera"));
  EXPECT_FALSE(window_->workspace().dirty()) << "looking names nothing";
  call("roof");
  EXPECT_TRUE(window_->workspace().dirty());
  save("roof.lvcalib");
  call("bumper");
  save("bumper.lvcalib");
  open(path("roof.lvcalib"));
  EXPECT_FALSE(window_->workspace().dirty());
  EXPECT_EQ(names(), Names("roof", "camera"));
  EXPECT_FALSE(window_->workspace().dirty());
  open(path("bumper.lvcalib"));
  EXPECT_EQ(names(), Names("bumper", "camera"));
  // A later session: a rig that is new starts with the last ones, a project with its own.
  answers_.unsaved_answer = widgets::UnsavedAnswer::kDiscard;
  make_window();
  open(dataset());
  EXPECT_EQ(names(), Names("bumper", "camera"));
  open(path("roof.lvcalib"));
  EXPECT_EQ(names(), Names("roof", "camera"));
}

TEST_F(ProjectsTest, DecisionsSurviveAKill) {
  window_.reset();
  QProcess child;
  child.start(QCoreApplication::applicationFilePath(),
              {QStringLiteral("--gtest_filter=Victim.DISABLED_WaitsToBeKilled"),
               QStringLiteral("--gtest_also_run_disabled_tests"), folder_.path(), dataset()});
  ASSERT_TRUE(child.waitForStarted());
  QByteArray said;
  ASSERT_TRUE(wait_until(
      [&] {
        child.waitForReadyRead(10);
        said += child.readAllStandardOutput();
        return said.contains("autosaved") || child.state() == QProcess::NotRunning;
      },
      30'000));
  ASSERT_TRUE(said.contains("autosaved")) << said.toStdString();
  EXPECT_TRUE(Autosave::find(path("data")).isEmpty()) << "taken from a running program";
  ::kill(static_cast<pid_t>(child.processId()), SIGKILL);
  ASSERT_TRUE(child.waitForFinished());
  ASSERT_EQ(Autosave::find(path("data")).size(), 1);
  answers_.recover_answer = true;
  make_window();
  window_->offer_recovery();
  EXPECT_EQ(answers_.asked_recover, 1);
  ASSERT_TRUE(window_->workspace().is_open());
  EXPECT_EQ(cell(*window_, "B", SceneModel::kState), "rejected");
  EXPECT_TRUE(window_->workspace().dirty());
  // The old copy goes only when there is a new one.
  const QString own = QStringLiteral("autosave-%1.lvcalib").arg(::getpid());
  ASSERT_TRUE(wait_until([&] { return QFile::exists(path("data/") + own); }, 5000));
  ASSERT_TRUE(wait_until([&] { return Autosave::find(path("data")).isEmpty(); }, 5000));
  // An orderly end leaves nothing.
  window_.reset();
  EXPECT_TRUE(QDir(path("data")).entryList({"autosave-*"}).isEmpty());
}

TEST_F(ProjectsTest, ARefusedRecoveryIsNotOfferedAgain) {
  window_.reset();
  QDir().mkpath(path("data"));
  Project project{dataset().toStdString(), {}, {}};
  const std::string text = "# project: \n" + project_as_text(project, path("data").toStdString());
  // No process has this id: it is above the system's limit.
  ASSERT_TRUE(
      write_file_atomically(path("data/autosave-99999999.lvcalib").toStdString(), text).ok());
  make_window();
  window_->offer_recovery();
  EXPECT_EQ(answers_.asked_recover, 1);
  EXPECT_FALSE(window_->workspace().is_open());
  window_->offer_recovery();
  EXPECT_EQ(answers_.asked_recover, 1);
}

// Runs in a process of its own, for DecisionsSurviveAKill.
TEST(Victim, DISABLED_WaitsToBeKilled) {
  const QStringList arguments = QCoreApplication::arguments();
  ASSERT_GE(arguments.size(), 3);
  widgets::AppSettings settings(arguments.at(arguments.size() - 2));
  test::Answers answers;
  MainWindow window(settings, answers);
  window.show();
  window.open(arguments.last());
  ASSERT_TRUE(wait_until([&] { return window.workspace().is_open(); }));
  test::click_scene(window, "B", true);
  ASSERT_TRUE(window.workspace().dirty());
  const QString file =
      settings.data_folder() + QStringLiteral("/autosave-%1.lvcalib").arg(::getpid());
  ASSERT_TRUE(wait_until([&] { return QFile::exists(file); }, 10'000));
  std::puts("autosaved");
  std::fflush(stdout);
  QTest::qWait(60'000);
}

}  // namespace
}  // namespace lvcalib::projects_test
