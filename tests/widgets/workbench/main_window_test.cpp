// SPDX-License-Identifier: GPL-3.0-or-later
#include "workbench/main_window.h"

#include <QClipboard>
#include <QCommandLinkButton>
#include <QDialog>
#include <QDir>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QDropEvent>
#include <QFile>
#include <QListWidget>
#include <QMimeData>
#include <QPlainTextEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QRegularExpression>
#include <QSignalSpy>
#include <QTabWidget>
#include <QTextBlock>
#include <QTextBrowser>
#include <QToolButton>
#include <QTreeWidget>
#include <QUndoStack>
#include <QUrl>
#include <filesystem>
#include <iostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file_io.h"
#include "dialogs/guide_dialog.h"
#include "docks/parameters_dock.h"
#include "docks/scenes_dock.h"
#include "intrinsics/camera_dialog.h"
#include "intrinsics/camera_page.h"
#include "pages/cloud_pane.h"
#include "pages/scene_page.h"
#include "report/result_file.h"
#include "start/coach_marks.h"
#include "support/pose_matchers.h"
#include "support/shared_data.h"
#include "views/cloud_canvas.h"
#include "views/cloud_pipeline.h"
#include "views/cloud_view.h"
#include "views/image_view.h"
#include "widgets/workbench/main_window_fixture.h"
#include "workbench/status_line.h"

namespace lvcalib::main_window_test {
namespace {

using test::cell;
using test::find;
using test::MainWindowTest;
using test::small_demo;
using test::trigger;
using test::wait_until;
using widgets::MainWindow;
using widgets::SceneModel;
using widgets::Workspace;

TEST_F(MainWindowTest, TheDemoIsSimulatedRunAndFoundRight) {
  window_->set_demo(small_demo());
  QTest::mouseClick(find<QCommandLinkButton>(*window_, "demo"), Qt::LeftButton);
  ASSERT_TRUE(wait_until([&] { return workspace().is_open() && !workspace().busy(); }));
  EXPECT_EQ(workspace().dataset().scenes.size(), 3U);
  QSignalSpy progress(&workspace(), &Workspace::progressed);
  QSignalSpy iterations(&workspace(), &Workspace::iterated);
  QSignalSpy boards(&workspace(), &Workspace::board_found);
  QTest::keyClick(window_.get(), Qt::Key_F5);
  EXPECT_TRUE(find<QProgressBar>(*window_, "progress")->isVisible());
  EXPECT_FALSE(find<QAction>(*window_, "run")->isEnabled());
  ASSERT_TRUE(test::wait_for_result(*window_));
  ASSERT_GT(progress.count(), 0);
  for (int k = 1; k < progress.count(); ++k)
    EXPECT_GE(progress.at(k).at(1).toDouble(), progress.at(k - 1).at(1).toDouble());
  EXPECT_GT(iterations.count(), 6);
  EXPECT_EQ(boards.count(), 3);
  const auto truth = read_truth(folder_.filePath("data/demo-truth.json").toStdString());
  ASSERT_TRUE(truth.ok());
  EXPECT_THAT(workspace().result()->extrinsic.camera_from_lidar.transform,
              test::IsNearPose(*truth, 5.0, 2.0));
  for (const char* scene : {"A", "B", "C"}) {
    EXPECT_EQ(cell(*window_, scene, SceneModel::kTags), "16");
    EXPECT_GT(cell(*window_, scene, SceneModel::kPoints).toInt(), 300);
    EXPECT_GT(cell(*window_, scene, SceneModel::kPixels).toDouble(), 0.0);
    EXPECT_GT(cell(*window_, scene, SceneModel::kMillimetres).toDouble(), 0.0);
    EXPECT_GT(cell(*window_, scene, SceneModel::kInfluence).toDouble(), 0.0);
    EXPECT_EQ(cell(*window_, scene, SceneModel::kState), "used");
  }
  EXPECT_FALSE(find<QProgressBar>(*window_, "progress")->isVisible());
  // The same as the command line's calculation.
  const auto whole = calibrate(workspace().dataset(), {}, {});
  ASSERT_TRUE(whole.ok());
  EXPECT_EQ(pose(), whole->extrinsic.camera_from_lidar.transform.matrix());
}

// The marks of the tour ask the tour where they stand: they must not outlive it.
TEST_F(MainWindowTest, ASecondDemoHasATourOfItsOwn) {
  window_->set_demo(small_demo());
  for (int time = 0; time < 2; ++time) {
    QSignalSpy opened(&workspace(), &Workspace::opened);
    ASSERT_TRUE(trigger(*window_, "demo"));
    ASSERT_TRUE(wait_until([&] { return opened.count() > 0 && !workspace().busy(); }));
    EXPECT_EQ(window_->findChildren<widgets::CoachMarks*>().size(), 1);
  }
  QTest::qWait(300);  // They look every fifth of a second.
}

TEST_F(MainWindowTest, ParametersAndLogAreClosedUntilTheyAreAskedFor) {
  EXPECT_FALSE(find<QDockWidget>(*window_, "scenes_dock")->isHidden());
  for (const char* name : {"parameters_dock", "log_dock"}) {
    auto* dock = find<QDockWidget>(*window_, name);
    ASSERT_NE(dock, nullptr) << name;
    EXPECT_TRUE(dock->isHidden()) << name;
    dock->toggleViewAction()->trigger();
    EXPECT_FALSE(dock->isHidden()) << name;
  }
}

TEST_F(MainWindowTest, UntickingSolvesAtOnceAndUndoBringsItBack) {
  run();
  const Eigen::Matrix4d all = pose();
  const auto before = workspace().result();
  QElapsedTimer clock;
  clock.start();
  test::click_scene(*window_, "B", true);
  EXPECT_FALSE(decision_of(workspace().decisions(), "B").use);
  EXPECT_TRUE(workspace().dirty());
  ASSERT_TRUE(test::wait_for_result(*window_));
  std::cout << "re-solve after a tick: " << clock.elapsed() << " ms\n";
  RecordProperty("resolve_ms", static_cast<int>(clock.elapsed()));
  EXPECT_NE(workspace().result(), before);
  EXPECT_NE(pose(), all);
  EXPECT_EQ(workspace().result()->times.detect_ms, before->times.detect_ms) << "ran a stage again";
  EXPECT_EQ(cell(*window_, "B", SceneModel::kState), "rejected");
  EXPECT_EQ(cell(*window_, "A", SceneModel::kState), "used");
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(test::wait_for_result(*window_));
  EXPECT_EQ(pose(), all);
  EXPECT_FALSE(workspace().dirty());
  EXPECT_EQ(cell(*window_, "B", SceneModel::kState), "used");
}

TEST_F(MainWindowTest, AcceptAndRejectActOnAllSelectedScenes) {
  open();
  auto* view = find<QTreeView>(*window_, "scenes");
  view->selectAll();
  ASSERT_TRUE(trigger(*window_, "reject"));
  for (const char* scene : {"A", "B", "C"})
    EXPECT_EQ(cell(*window_, scene, SceneModel::kState), "rejected");
  // With nothing in use, a run says so in a dialog that names the dataset.
  ASSERT_TRUE(trigger(*window_, "run"));
  ASSERT_TRUE(wait_until([&] { return find<QDialog>(*window_, "error_dialog") != nullptr; }));
  auto* dialog = find<QDialog>(*window_, "error_dialog");
  bool named = false;
  for (const QLabel* label : dialog->findChildren<QLabel*>())
    named = named || label->text().contains(dataset());
  EXPECT_TRUE(named);
  QTest::keyClick(dialog, Qt::Key_Escape);
  ASSERT_TRUE(trigger(*window_, "accept"));
  EXPECT_EQ(cell(*window_, "B", SceneModel::kState), "not run");
}

TEST_F(MainWindowTest, AParameterRunsFromItsStageAndIsOneUndoStep) {
  run();
  const Eigen::Matrix4d first = pose();
  auto* box = find<QDoubleSpinBox>(*window_, "refinement.max_bins");
  ASSERT_NE(box, nullptr);
  EXPECT_EQ(box->value(), 24);
  EXPECT_TRUE(box->toolTip().contains("24"));
  QSignalSpy iterations(&workspace(), &Workspace::iterated);
  for (int i = 0; i < 4; ++i) QTest::keyClick(box, Qt::Key_Down);
  EXPECT_EQ(workspace().decisions().options.refinement.max_bins, 20);
  EXPECT_EQ(workspace().undo_stack().count(), 1);
  EXPECT_FALSE(workspace().up_to_date());
  ASSERT_TRUE(test::wait_for_result(*window_));
  EXPECT_GT(iterations.count(), 0);
  EXPECT_EQ(workspace().result()->times.localize_ms, 0.0) << "an earlier stage ran again";
  EXPECT_NE(pose(), first);
  QTest::mouseClick(find<QToolButton>(*window_, "reset refinement.max_bins"), Qt::LeftButton);
  EXPECT_EQ(box->value(), 24);
  ASSERT_TRUE(test::wait_for_result(*window_));
  EXPECT_EQ(pose(), first);
}

TEST_F(MainWindowTest, ACropBoxRunsItsSceneAgainAndCanBeUndone) {
  run();
  const Eigen::Matrix4d first = pose();
  const auto number = [&](const char* name) -> QDoubleSpinBox* {
    for (auto* box : window_->findChildren<QDoubleSpinBox*>()) {
      if (box->accessibleName() == QLatin1String(name)) return box;
    }
    return nullptr;
  };
  ASSERT_TRUE(trigger(*window_, "crop-action"));
  const Eigen::Vector3d middle =
      workspace().result()->scenes[0].refinement->nodes[4].center_lidar_m;
  const char* const axes[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k) {
    auto* center = number((std::string("Middle ") + axes[k]).c_str());
    auto* side = number((std::string("Side ") + axes[k]).c_str());
    ASSERT_TRUE(center != nullptr && side != nullptr);
    center->setValue(middle(k));
    side->setValue(2.5);
  }
  // Another decision does not close the box that is being edited.
  test::click_scene(*window_, "C", true);
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(test::wait_for_result(*window_));
  QTest::mouseClick(find<QPushButton>(*window_, "crop-use"), Qt::LeftButton);
  const auto crop = decision_of(workspace().decisions(), "A").crop;
  ASSERT_TRUE(crop.has_value());
  EXPECT_TRUE(crop->contains(middle));
  EXPECT_NEAR(crop->half_size_m.x(), 1.25, 1e-9);
  ASSERT_TRUE(test::wait_for_result(*window_));
  EXPECT_EQ(workspace().result()->times.detect_ms, 0.0) << "images were looked at again";
  EXPECT_EQ(cell(*window_, "A", SceneModel::kState), "used (cropped)");
  EXPECT_EQ(cell(*window_, "B", SceneModel::kState), "used");
  const auto whole = calibrate(workspace().dataset(),
                               request_of(workspace().dataset(), workspace().decisions()), {});
  ASSERT_TRUE(whole.ok());
  EXPECT_EQ(pose(), whole->extrinsic.camera_from_lidar.transform.matrix());
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(test::wait_for_result(*window_));
  EXPECT_EQ(pose(), first);
  EXPECT_EQ(cell(*window_, "A", SceneModel::kState), "used");
}

// On the Camera page: the result follows at once, and another scene's decisions stay.
TEST_F(MainWindowTest, ImagesOfTheCameraThatAreAddedCountInTheResult) {
  const QString own = folder_.filePath("own");
  std::filesystem::copy(dataset().toStdString(), own.toStdString(),
                        std::filesystem::copy_options::recursive);
  answers_.dataset = own;
  ASSERT_TRUE(trigger(*window_, "open_dataset"));
  ASSERT_TRUE(wait_until([&] { return workspace().is_open() && !workspace().busy(); }));
  QTest::keyClick(window_.get(), Qt::Key_F5);
  ASSERT_TRUE(test::wait_for_result(*window_));
  EXPECT_TRUE(workspace().result()->intrinsics.extra_images.empty());
  answers_.images = QStringList{own + "/scenes/A/image.png"};
  find<QPushButton>(*window_, "camera_add")->click();
  ASSERT_TRUE(wait_until([&] { return workspace().result()->intrinsics.extra_images.size() == 1; },
                         60'000));
  // It is that of a scene, and says so where images are listed.
  auto* tabs = find<QTabWidget>(*window_, "pages");
  tabs->setCurrentIndex(tabs->count() - 1);
  auto* images = find<QTreeWidget>(*window_, "camera_images");
  ASSERT_TRUE(wait_until([&] { return images->topLevelItemCount() == 4; }, 10'000));
  EXPECT_EQ(images->topLevelItem(3)->text(0), QStringLiteral("intrinsics/image.png"));
  EXPECT_FALSE(images->topLevelItem(3)->text(3).isEmpty());
}

// Nothing is open; the folder is a dataset all the same, of which the images are taken.
TEST_F(MainWindowTest, ACameraAloneNeedsNoDataset) {
  ASSERT_FALSE(workspace().is_open());
  ASSERT_TRUE(trigger(*window_, "camera_alone"));
  auto* dialog = find<widgets::CameraDialog>(*window_, "camera_dialog");
  ASSERT_NE(dialog, nullptr);
  answers_.camera_images = dataset();
  find<QPushButton>(*dialog, "photos_choose_folder")->click();
  ASSERT_TRUE(wait_until([&] { return !dialog->busy(); }));
  find<QPushButton>(*dialog, "camera_calibrate")->click();
  ASSERT_TRUE(wait_until([&] { return dialog->page().calibration() && !dialog->busy(); }));
  answers_.export_to = folder_.filePath("camera.yaml");
  find<QPushButton>(*dialog, "camera_save")->click();
  EXPECT_TRUE(read_camera(answers_.export_to.toStdString()).ok());
  EXPECT_EQ(settings_->last_folder(), folder_.path());
  EXPECT_FALSE(workspace().is_open());
}

TEST_F(MainWindowTest, LengthsAreShownInMillimetres) {
  open();
  auto* step = find<QDoubleSpinBox>(*window_, "refinement.max_step_m");
  EXPECT_EQ(step->suffix(), " mm");
  EXPECT_DOUBLE_EQ(step->value(), 5.0);
  step->setValue(2.5);
  EXPECT_DOUBLE_EQ(workspace().decisions().options.refinement.max_step_m, 0.0025);
  // No option loses its default by being shown.
  for (const OptionDeclaration& option : option_declarations()) {
    const auto* box = window_->findChild<QDoubleSpinBox*>(QString::fromStdString(option.key));
    if (box == nullptr || option.key == "refinement.max_step_m") continue;
    const double factor = widgets::display_of(option).factor;
    EXPECT_NEAR(box->value() / factor, option.default_value(), 1e-9 * option.default_value())
        << option.key;
  }
}

TEST_F(MainWindowTest, CancelActsAndNothingIsLost) {
  open();
  for (const int delay_ms : {0, 30, 150, 400, 800, 1200}) {
    trigger(*window_, "run");
    QTest::qWait(delay_ms);
    if (!workspace().busy()) break;  // Done already.
    QTest::keyClick(window_.get(), Qt::Key_Escape);
    ASSERT_TRUE(wait_until([&] { return !workspace().busy(); }, 5000))
        << "after " << delay_ms << " ms";
    EXPECT_TRUE(find<QAction>(*window_, "run")->isEnabled());
  }
  trigger(*window_, "run");
  ASSERT_TRUE(test::wait_for_result(*window_));
  const auto whole = calibrate(workspace().dataset(), {}, {});
  ASSERT_TRUE(whole.ok());
  EXPECT_EQ(pose(), whole->extrinsic.camera_from_lidar.transform.matrix());
}

TEST_F(MainWindowTest, ClosingDuringARunIsSafe) {
  open();
  trigger(*window_, "run");
  QTest::qWait(200);
  EXPECT_TRUE(window_->close());
  window_.reset();
  QTest::qWait(300);  // What the worker still sends must find nobody.
  EXPECT_TRUE(widgets::Runner::wait_for_workers(60'000));
}

TEST_F(MainWindowTest, ResultsAreShownCopiedAndExported) {
  run();
  ASSERT_TRUE(trigger(*window_, "results"));
  auto* dialog = find<QDialog>(*window_, "results_dialog");
  ASSERT_NE(dialog, nullptr);
  QTest::mouseClick(find<QPushButton>(*dialog, "copy"), Qt::LeftButton);
  const auto numbers =
      QApplication::clipboard()->text().split(QRegularExpression("\\s+"), Qt::SkipEmptyParts);
  ASSERT_EQ(numbers.size(), 16);
  for (int i = 0; i < 16; ++i) EXPECT_NEAR(numbers[i].toDouble(), pose()(i / 4, i % 4), 1e-8);
  answers_.export_to = folder_.filePath("r.json");
  QTest::mouseClick(find<QPushButton>(*dialog, "export_json"), Qt::LeftButton);
  const auto stored = read_result(answers_.export_to.toStdString());
  ASSERT_TRUE(stored.ok()) << stored.error().text();
  EXPECT_THAT(
      stored->camera_from_lidar,
      test::IsNearPose(workspace().result()->extrinsic.camera_from_lidar.transform, 1e-6, 1e-6));
  answers_.export_to = folder_.filePath("r.yaml");
  QTest::mouseClick(find<QPushButton>(*dialog, "export_yaml"), Qt::LeftButton);
  EXPECT_EQ(*read_text_file(answers_.export_to.toStdString(), 1 << 20),
            result_as_yaml(*workspace().result()));
  // A place that cannot be written is named.
  answers_.export_to = folder_.filePath("no/such/folder/r.yaml");
  QTest::mouseClick(find<QPushButton>(*dialog, "export_yaml"), Qt::LeftButton);
  auto* error = find<QDialog>(*window_, "error_dialog");
  ASSERT_NE(error, nullptr);
  error->close();
}

TEST_F(MainWindowTest, TheReportIsWrittenFromTheMenu) {
  EXPECT_FALSE(trigger(*window_, "report"));
  run();
  answers_.export_to = folder_.filePath("report.html");
  ASSERT_TRUE(trigger(*window_, "report"));
  ASSERT_TRUE(wait_until([&] { return QFile::exists(answers_.export_to); }));
  const auto html = read_text_file(answers_.export_to.toStdString(), 1 << 26);
  ASSERT_TRUE(html.ok());
  EXPECT_NE(html->find("data:image/jpeg;base64,"), std::string::npos);  // With its photographs.
}

TEST_F(MainWindowTest, UnusableThingsAreNamedAndNothingOpens) {
  window_->open(folder_.filePath("nowhere"));
  ASSERT_TRUE(wait_until([&] { return find<QDialog>(*window_, "error_dialog") != nullptr; }));
  bool named = false;
  for (const QLabel* label : find<QDialog>(*window_, "error_dialog")->findChildren<QLabel*>())
    named = named || label->text().contains("nowhere");
  EXPECT_TRUE(named);
  EXPECT_FALSE(workspace().is_open());
  // A folder that has gone says what to do, and that is at hand.
  auto* dialog = find<QDialog>(*window_, "error_dialog");
  bool told = false;
  for (const QLabel* label : dialog->findChildren<QLabel*>())
    told = told || label->text().contains("What to do: open it where it is now");
  EXPECT_TRUE(told);
  EXPECT_NE(find<QPushButton>(*dialog, "import_files"), nullptr);
  EXPECT_NE(find<QPushButton>(*dialog, "import_recording"), nullptr);
}

// Before anything is calibrated, whatever the LiDAR; rigs of others are passed over where they are
// not there.
TEST_F(MainWindowTest, TheWindowFramesTheBoardOnOpening) {
  for (const std::filesystem::path& rig :
       {std::filesystem::path(dataset().toStdString()), test::shared_rig("simulated/clean-avia"),
        test::shared_rig("simulated/walk-rosette"), test::shared_rig("real/vlp16-checkerboard")}) {
    if (!std::filesystem::exists(rig)) continue;
    window_ = std::make_unique<MainWindow>(*settings_, answers_);
    window_->show();
    const widgets::CloudView* view = window_->findChild<widgets::ScenePage*>()->cloudPane()->view();
    window_->open(QString::fromStdString(rig.string()));
    ASSERT_TRUE(wait_until([&] { return view->scene() && view->scene()->board_is_likely; })) << rig;
    EXPECT_FALSE(workspace().result());
    if (!view->hasOpenGl()) continue;
    // It is flown to.
    EXPECT_TRUE(wait_until([&] {
      const Eigen::Vector3d focus_m = view->canvas()->pipeline().viewer().focus_m;
      return (focus_m - view->scene()->board_center_m).norm() < 1e-6;
    })) << rig;
  }
}

TEST_F(MainWindowTest, AFolderDroppedOnTheWindowOpensAndIsRemembered) {
  QMimeData mime;
  mime.setUrls({QUrl::fromLocalFile(dataset())});
  QDragEnterEvent enter(QPoint(10, 10), Qt::CopyAction, &mime, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(window_.get(), &enter);
  EXPECT_TRUE(enter.isAccepted());
  QDropEvent drop(QPointF(10, 10), Qt::CopyAction, &mime, Qt::LeftButton, Qt::NoModifier);
  // Without a platform's drag there is no drop target for sendEvent() to find.
  static_cast<QObject*>(window_.get())->event(&drop);
  ASSERT_TRUE(wait_until([&] { return workspace().is_open(); }, 5000));
  EXPECT_EQ(settings_->recent(), QStringList{dataset()});
  window_->close();
  window_ = std::make_unique<MainWindow>(*settings_, answers_);
  auto* recent = find<QListWidget>(*window_, "recent");
  ASSERT_EQ(recent->count(), 1);
  Q_EMIT recent->itemActivated(recent->item(0));
  ASSERT_TRUE(wait_until([&] { return workspace().is_open(); }));
}

// With nothing open there is nothing that several could be scenes of: that is said.
TEST_F(MainWindowTest, SeveralPathsDroppedOnTheWelcomePageAreAnswered) {
  QTest::qWait(50);  // The window says nothing more of its own.
  QMimeData mime;
  mime.setUrls({QUrl::fromLocalFile(dataset()), QUrl::fromLocalFile(folder_.path())});
  QDragEnterEvent enter(QPoint(10, 10), Qt::CopyAction, &mime, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(window_.get(), &enter);
  EXPECT_TRUE(enter.isAccepted());
  QDropEvent drop(QPointF(10, 10), Qt::CopyAction, &mime, Qt::LeftButton, Qt::NoModifier);
  static_cast<QObject*>(window_.get())->event(&drop);
  QTest::qWait(50);
  EXPECT_FALSE(workspace().is_open());
  const QString said = window_->findChild<widgets::StatusLine*>()->text();
  EXPECT_TRUE(said.contains("drop one folder")) << said.toStdString();
}

TEST_F(MainWindowTest, ThemesAndLanguagesSwitchWhileOpen) {
  open();
  for (QAction* action : window_->findChildren<QAction*>("theme")) {
    action->trigger();
    QTest::qWait(20);
    EXPECT_EQ(name_of(settings_->theme()), action->data().toString());
  }
  for (QAction* action : window_->findChildren<QAction*>("language")) {
    action->trigger();
    QTest::qWait(20);
    EXPECT_EQ(settings_->language(), action->data().toString());
  }
  for (QAction* action : window_->findChildren<QAction*>("language")) {
    if (action->data().toString() == "en") action->trigger();
  }
  QTest::qWait(20);
  EXPECT_EQ(find<QAction>(*window_, "run")->text(), "&Run all");
}

// What ran and why; a run after a change keeps what the change does not touch.
TEST_F(MainWindowTest, TheLogSaysWhatRanAndWhy) {
  run();
  auto* log = find<QPlainTextEdit>(*window_, "log");
  const QString first = log->toPlainText();
  EXPECT_TRUE(first.contains("Ran (first run, or asked for): images")) << first.toStdString();
  EXPECT_FALSE(first.contains("Kept:"));
  log->clear();
  auto options = workspace().decisions().options;
  for (const OptionDeclaration& option : option_declarations()) {
    if (option.key == "refinement.max_iterations")
      workspace().set_option(option, option.get(options) + 1.0);
  }
  QTest::keyClick(window_.get(), Qt::Key_F5);
  ASSERT_TRUE(wait_until([&] { return log->toPlainText().contains("Ran ("); }));
  const QString again = log->toPlainText();
  EXPECT_TRUE(again.contains("Ran (options changed): refinement")) << again.toStdString();
  EXPECT_TRUE(again.contains("Kept: images, search in the clouds.")) << again.toStdString();
}

// Each bad scene is red with its reason, the others are solved, and mended files are taken up.
TEST_F(MainWindowTest, OneBadFileCostsOneScene) {
  namespace fs = std::filesystem;
  const fs::path bad = folder_.filePath("bad").toStdString();
  fs::copy(dataset().toStdString(), bad, fs::copy_options::recursive);
  fs::copy(bad / "scenes/A", bad / "scenes/D", fs::copy_options::recursive);
  fs::remove(bad / "scenes/D/cloud.pcd");
  // An image of another size than the intrinsics are for.
  fs::copy(bad / "scenes/B", bad / "scenes/E", fs::copy_options::recursive);
  const QString wrong = QString::fromStdString((bad / "scenes/E/image.png").string());
  const QImage whole(wrong);
  ASSERT_TRUE(whole.copy(0, 0, whole.width() / 2, whole.height() / 2).save(wrong));
  fs::resize_file(bad / "scenes/B/cloud.pcd", fs::file_size(bad / "scenes/B/cloud.pcd") / 2);
  fs::resize_file(bad / "scenes/C/image.png", 0);
  window_->open(QString::fromStdString(bad.string()));
  ASSERT_TRUE(wait_until([&] { return workspace().is_open() && !workspace().busy(); }));
  const auto state = [&](const char* scene) { return cell(*window_, scene, SceneModel::kState); };
  // Before anything runs.
  ASSERT_TRUE(wait_until([&] { return state("C").contains("image.png"); }, 10'000));
  ASSERT_TRUE(wait_until([&] { return state("D").contains("no cloud"); }, 10'000));
  auto* scenes = window_->findChild<widgets::ScenesDock*>();
  scenes->select("B");
  ASSERT_TRUE(wait_until([&] { return state("B").contains("truncated"); }, 10'000));
  auto* cloud_notice = find<QLabel>(*window_->findChild<widgets::ScenePage*>(), "cloud-notice");
  ASSERT_TRUE(wait_until([&] { return cloud_notice->text().contains("truncated"); }, 10'000));
  auto* image = window_->findChild<widgets::ScenePage*>()->findChild<widgets::ImageView*>();
  EXPECT_FALSE(image->image().isNull()) << "the image of B is sound";
  scenes->select("C");
  ASSERT_TRUE(wait_until([&] { return image->message().contains("image.png"); }, 10'000));
  QTest::keyClick(window_.get(), Qt::Key_F5);
  ASSERT_TRUE(wait_until([&] { return !workspace().busy(); }));
  EXPECT_TRUE(state("B").contains("truncated")) << state("B").toStdString();
  EXPECT_TRUE(state("C").contains("image.png"));
  EXPECT_TRUE(state("D").contains("no cloud"));
  EXPECT_TRUE(state("E").contains("pixels")) << state("E").toStdString();
  ASSERT_TRUE(workspace().result());
  EXPECT_EQ(workspace().result()->extrinsic.used_scenes, 1);
  // Mended, and run again.
  for (const char* file : {"scenes/B/cloud.pcd", "scenes/C/image.png"})
    fs::copy_file(dataset().toStdString() / fs::path(file), bad / file,
                  fs::copy_options::overwrite_existing);
  QTest::keyClick(window_.get(), Qt::Key_F5);
  ASSERT_TRUE(test::wait_for_result(*window_));
  EXPECT_EQ(workspace().result()->extrinsic.used_scenes, 3);
  EXPECT_EQ(state("C"), "used");
  ASSERT_TRUE(wait_until([&] { return !image->image().isNull(); }, 10'000));
  // Another dataset brings its own pictures.
  window_->open(folder_.path());
  ASSERT_TRUE(wait_until([&] { return find<QDialog>(*window_, "error_dialog") != nullptr; }));
  const auto labels = find<QDialog>(*window_, "error_dialog")->findChildren<QLabel*>();
  EXPECT_TRUE(std::any_of(labels.begin(), labels.end(), [](const QLabel* label) {
    return label->text().contains("scenes/NAME/");
  })) << "what a dataset is";
}

// Whoever opens a folder of something else has at hand what makes a dataset of it.
TEST_F(MainWindowTest, AFolderThatIsNoDatasetOffersToMakeOne) {
  const QString folder = folder_.filePath("photographs");
  ASSERT_TRUE(QDir().mkpath(folder));
  window_->open(folder);
  ASSERT_TRUE(wait_until([&] { return find<QDialog>(*window_, "error_dialog") != nullptr; }));
  auto* dialog = find<QDialog>(*window_, "error_dialog");
  EXPECT_NE(find<QPushButton>(*dialog, "import_recording"), nullptr);
  auto* files = find<QPushButton>(*dialog, "import_files");
  ASSERT_NE(files, nullptr);
  answers_.files = folder;
  QTest::mouseClick(files, Qt::LeftButton);
  EXPECT_FALSE(dialog->isVisible());
  auto* import = find<QDialog>(*window_, "files_dialog");
  ASSERT_NE(import, nullptr);
  EXPECT_TRUE(import->isVisible());
  import->close();
  // What is wrong in a dataset is no reason to make another.
  const QString broken = folder_.filePath("broken");
  std::filesystem::copy(dataset().toStdString(), broken.toStdString(),
                        std::filesystem::copy_options::recursive);
  std::filesystem::resize_file((broken + "/camera.yaml").toStdString(), 0);
  QTest::qWait(20);
  window_->open(broken);
  ASSERT_TRUE(wait_until([&] { return find<QDialog>(*window_, "error_dialog") != nullptr; }));
  EXPECT_EQ(find<QPushButton>(*find<QDialog>(*window_, "error_dialog"), "import_files"), nullptr);
}

// The same window, at the chapter of the page in view, however often it is asked for.
TEST_F(MainWindowTest, F1OpensTheGuideAtThePageInView) {
  open();
  const char* const chapters[] = {"Scene", "Refinement", "Extrinsic", "Boundary response", "Model"};
  auto* tabs = find<QTabWidget>(*window_, "pages");
  for (int page = 0; page < 5; ++page) {
    tabs->setCurrentIndex(page);
    window_->activateWindow();
    ASSERT_TRUE(wait_until([&] { return QApplication::activeWindow() == window_.get(); }, 5000));
    QSignalSpy asked(find<QAction>(*window_, "guide"), &QAction::triggered);
    QTest::keyClick(window_.get(), Qt::Key_F1);
    ASSERT_EQ(asked.count(), 1);
    QTest::qWait(50);
    const auto guides = window_->findChildren<widgets::GuideDialog*>();
    ASSERT_EQ(guides.size(), 1);
    const auto* text = guides.first()->findChild<QTextBrowser*>();
    EXPECT_EQ(text->cursorForPosition({20, 12}).block().text().toStdString(), chapters[page]);
  }
}

// Several folders dropped on the window are scenes for what is open; notes and the list's order are
// decisions that run nothing.
TEST_F(MainWindowTest, ScenesAreDroppedNotedAndOrdered) {
  open();
  QStringList folders;
  QList<QUrl> urls;
  for (const char* name : {"X", "Y"}) {
    const QString folder = folder_.filePath(QString::fromLatin1(name));
    std::filesystem::copy(dataset().toStdString() + "/scenes/A", folder.toStdString());
    urls << QUrl::fromLocalFile(folder);
  }
  QMimeData data;
  data.setUrls(urls);
  QDropEvent drop(QPointF(20, 20), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  static_cast<QObject*>(window_.get())->event(&drop);
  ASSERT_EQ(workspace().dataset().scenes.size(), 5U);
  QSignalSpy started(&workspace(), &Workspace::run_started);
  auto* dock = window_->findChild<widgets::ScenesDock*>();
  Q_EMIT dock->note_wanted("Y", "by the door");
  Q_EMIT dock->order_wanted({"Y", "X", "A", "B", "C"});
  QTest::qWait(2 * Workspace::kSettleMs);
  EXPECT_EQ(started.count(), 0);
  EXPECT_EQ(cell(*window_, "Y", SceneModel::kNote), "by the door");
  EXPECT_TRUE(workspace().dirty());
  workspace().undo_stack().undo();
  workspace().undo_stack().undo();
  EXPECT_EQ(cell(*window_, "Y", SceneModel::kNote), "");
}

}  // namespace
}  // namespace lvcalib::main_window_test
