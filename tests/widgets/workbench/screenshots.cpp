// SPDX-License-Identifier: GPL-3.0-or-later
// Usage: lvcalib-screenshots FOLDER [DATASET|demo] [LANGUAGE] [WIDTHxHEIGHT] [quick|model|opened|
// covered [dark]]. Opens a dataset (without one: the demo), runs it and writes a picture of every
// page and dialog to the folder, in light and dark; quick: in one of both; model: of the Model page
// alone; opened: of the window before and after the run; covered: of the demo with a post before
// one of its boards. The size is the window's.

#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QDir>
#include <QElapsedTimer>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QScreen>
#include <QSurfaceFormat>
#include <QTabWidget>
#include <QTemporaryDir>
#include <QTimer>
#include <QToolButton>
#include <QTreeWidget>
#include <QUndoStack>
#include <cstdio>

#include "importing/stretch_list.h"
#include "intrinsics/camera_dialog.h"
#include "intrinsics/camera_page.h"
#include "modelling/residual_plot.h"
#include "pipeline/refusals.h"
#include "report/result_file.h"
#include "runner/demo.h"
#include "simulation/dataset_writer.h"
#include "start/coach_marks.h"
#include "support/covered_board.h"
#include "tools/check_dialog.h"
#include "tools/compare_dialog.h"
#include "tools/plan_dialog.h"
#include "tools/watch_window.h"
#include "views/cloud_view.h"
#include "widgets/importing/recorded_walk.h"
#include "widgets/support/driver.h"

namespace {

using namespace lvcalib;

class Photographer {
 public:
  Photographer(widgets::MainWindow& window, QString folder)
      : window_(window), folder_(std::move(folder)) {}

  void take(const QString& name, QWidget* widget = nullptr) {
    QTest::qWait(800);  // Views build their scenes in the background.
    // On a busy machine plots wait for their turn to be drawn: until nothing waits.
    QElapsedTimer turn;
    for (int k = 0; k < 50; ++k) {
      turn.start();
      QTest::qWait(50);
      if (turn.elapsed() < 100) break;
    }
    take_at_once(name, widget);
  }
  void take_at_once(const QString& name, QWidget* widget = nullptr) {
    QWidget* shown = widget == nullptr ? &window_ : widget;
    const QString path = QDir(folder_).filePath(name + QStringLiteral(".png"));
    // From the screen: a grab of widgets would miss what OpenGL drew.
    const QRect r = shown->frameGeometry();
    const QPixmap picture =
        QGuiApplication::primaryScreen()->grabWindow(0, r.x(), r.y(), r.width(), r.height());
    if (!picture.save(path)) std::fprintf(stderr, "cannot write %s\n", qPrintable(path));
  }

 private:
  widgets::MainWindow& window_;
  QString folder_;
};

void choose(const widgets::MainWindow& window, const char* what, const QString& value) {
  for (QAction* action : window.findChildren<QAction*>(QString::fromLatin1(what))) {
    if (action->data().toString() == value) action->trigger();
  }
}

void photograph_pages(widgets::MainWindow& window, Photographer& camera, const QString& theme) {
  const QStringList names = {QStringLiteral("scene"),     QStringLiteral("refinement"),
                             QStringLiteral("extrinsic"), QStringLiteral("response"),
                             QStringLiteral("model"),     QStringLiteral("camera-page")};
  auto* tabs = test::find<QTabWidget>(window, "pages");
  for (int tab = 0; tab < tabs->count(); ++tab) {
    tabs->setCurrentIndex(tab);
    const QString name = names.value(tab, QStringLiteral("page-%1").arg(tab + 1));
    camera.take(name + QLatin1Char('-') + theme);
    if (name == QLatin1String("scene")) {
      auto* crop = test::find<QAction>(window, "crop-action");
      crop->setChecked(true);
      camera.take(QStringLiteral("crop-") + theme);
      crop->setChecked(false);
    }
    // Pages within the page: the pose's neighbours, the response's tables.
    auto* inner = tabs->currentWidget()->findChild<QTabWidget*>();
    for (int k = 1; inner != nullptr && k < inner->count(); ++k) {
      inner->setCurrentIndex(k);
      camera.take(QStringLiteral("%1-%2-%3").arg(name).arg(k + 1).arg(theme));
    }
    if (inner != nullptr) inner->setCurrentIndex(0);
    auto* page = qobject_cast<widgets::CameraPage*>(tabs->currentWidget());
    if (page == nullptr) continue;
    test::find<QPushButton>(*page, "camera_calibrate")->click();
    test::wait_until([page] { return page->calibration() && !page->busy(); }, 60'000);
    camera.take(QStringLiteral("camera-page-alone-") + theme);
    inner->setCurrentIndex(1);
    camera.take(QStringLiteral("camera-page-alone-2-") + theme);
    inner->setCurrentIndex(0);
  }
}

// A scene of which the program refused a circle, on the pages that show it.
void photograph_refused(widgets::MainWindow& window, Photographer& camera, const QString& theme) {
  for (const Refusal& refusal : refusals(*window.workspace().result())) {
    if (refusal.what != Refusal::What::kCircle) continue;
    test::click_scene(window, QString::fromStdString(refusal.scene), false);
    auto* tabs = test::find<QTabWidget>(window, "pages");
    tabs->setCurrentIndex(0);
    QTest::qWait(1500);
    camera.take(QStringLiteral("refused-") + theme);
    tabs->setCurrentIndex(1);
    auto* page = tabs->currentWidget();
    QMetaObject::invokeMethod(page, "chooseNode", Q_ARG(int, refusal.id));
    camera.take(QStringLiteral("refused-2-") + theme);
    const std::string& first = window.workspace().dataset().scenes.front().name;
    test::click_scene(window, QString::fromStdString(first), false);
    return;
  }
}

// The Scene page with a tag, a circle and points left out by hand.
void photograph_left_out(widgets::MainWindow& window, Photographer& camera, const QString& theme) {
  const CalibrationResult& result = *window.workspace().result();
  const SceneResult& scene = result.scenes.front();
  SceneEdits edits;
  edits.tags = {scene.view->corners.front().feature_id};
  if (scene.refinement && !scene.refinement->nodes.empty())
    edits.circles = {scene.refinement->nodes.back().id};
  if (scene.refinement && result.target.has_circles()) {
    edits.patches_m = {ring_patch(result.target, 0, -1.0, 0.5)};
    const Eigen::Vector2d middle = result.target.outline().center_m();
    edits.patches_m.push_back(
        BoardOutline{middle - Eigen::Vector2d(0.12, 0.16), middle + Eigen::Vector2d(0.1, -0.05)}
            .corners_m());
  }
  for (std::size_t i = 0; i < scene.board_points.size(); i += 40)
    edits.points_m.push_back(scene.board_points.points_m[i]);
  window.workspace().set_edits({{QString::fromStdString(scene.name), edits}});
  test::wait_until([&] { return window.workspace().up_to_date() && !window.workspace().busy(); });
  test::find<QTabWidget>(window, "pages")->setCurrentIndex(0);
  camera.take(QStringLiteral("left-out-") + theme);
  auto* tabs = test::find<QTabWidget>(window, "pages");
  for (const int page : {1, 3}) {
    tabs->setCurrentIndex(page);
    camera.take(QStringLiteral("left-out-%1-%2").arg(page + 1).arg(theme));
  }
  tabs->setCurrentIndex(0);
  window.workspace().undo_stack().undo();
  test::wait_until([&] { return window.workspace().up_to_date() && !window.workspace().busy(); });
}

// A plan that goes on from the scenes taken, for an effect that is hard to see.
void photograph_plan(widgets::MainWindow& window, Photographer& camera, const QString& theme) {
  test::trigger(window, "plan_scenes");
  auto* dialog = test::find<widgets::PlanDialog>(window, "plan_dialog");
  auto* effects = test::find<QListWidget>(*dialog, "plan_effects");
  for (int i = 0; i < effects->count(); ++i) {
    const QString id = effects->item(i)->data(Qt::UserRole).toString();
    if (id == QLatin1String("range_walk") || id == QLatin1String("board_bow"))
      effects->item(i)->setCheckState(Qt::Checked);
  }
  test::find<QPushButton>(*dialog, "plan_start")->click();
  test::wait_until([&] { return !dialog->busy(); });
  auto* table = test::find<QTreeWidget>(*dialog, "plan_table");
  table->setCurrentItem(table->topLevelItem(2));
  camera.take(QStringLiteral("plan-") + theme, dialog);
  dialog->close();
}

void photograph_watch(widgets::MainWindow& window, Photographer& camera, const QString& theme) {
  test::trigger(window, "watch_dataset");
  auto* next = test::find<widgets::WatchWindow>(window, "watch_window");
  next->move(0, 0);
  test::wait_until([&] { return !next->busy(); });
  camera.take(QStringLiteral("watch-") + theme, next);
  test::trigger(window, "watch_dataset");
  next->close();
}

void photograph_dialogs(widgets::MainWindow& window, Photographer& camera, const QString& theme) {
  const auto take = [&](const char* object, const QString& name) {
    if (auto* dialog = test::find<QDialog>(window, object)) {
      camera.take(name + QLatin1Char('-') + theme, dialog);
      dialog->close();
    }
  };
  test::trigger(window, "results");
  if (auto* results = test::find<QDialog>(window, "results_dialog")) {
    camera.take(QStringLiteral("results-") + theme, results);
    test::find<QTabWidget>(*results, "results_tabs")->setCurrentIndex(1);
    auto* formats = test::find<QListWidget>(*results, "formats");
    formats->setCurrentItem(
        formats->findItems(QStringLiteral("kalibr"), Qt::MatchExactly).value(0));
  }
  take("results_dialog", QStringLiteral("exports"));
  const QTemporaryDir folder;
  const auto result = window.workspace().result();
  CalibrationResult other = *result;
  other.extrinsic.camera_from_lidar.transform.translation.x() += 2e-4;
  const auto written = folder.filePath(QStringLiteral("rig-in-spring")).toStdString();
  if (write_results(other, written).ok()) {
    test::trigger(window, "compare_results");
    test::find<widgets::CompareDialog>(window, "compare_dialog")
        ->add(widgets::ComparedResult::Kind::kFile,
              QString::fromStdString(written + "/result.json"));
  }
  take("compare_dialog", QStringLiteral("compare"));
  test::trigger(window, "check_fresh_data");
  if (auto* check = test::find<widgets::CheckDialog>(window, "check_dialog"))
    test::wait_until([&] { return !check->busy(); }, 60'000);
  take("check_dialog", QStringLiteral("check"));
  test::trigger(window, "correct_clouds");
  take("correct_dialog", QStringLiteral("correct"));
  test::trigger(window, "target_camera");
  if (auto* forms = test::find<QDialog>(window, "target_camera_dialog")) {
    camera.take(QStringLiteral("target-") + theme, forms);
    test::find<QTabWidget>(*forms, "target_camera_tabs")->setCurrentIndex(1);
  }
  take("target_camera_dialog", QStringLiteral("camera"));
  test::trigger(window, "camera_alone");
  if (auto* alone = test::find<widgets::CameraDialog>(window, "camera_dialog")) {
    auto* images = test::find<QLineEdit>(*alone, "photos_folder");
    images->setText(QString::fromStdString(window.workspace().dataset().path.string()));
    images->setModified(true);
    Q_EMIT images->editingFinished();
    test::wait_until([&] { return !alone->busy(); }, 60'000);
    test::find<QPushButton>(*alone, "camera_calibrate")->click();
    test::wait_until([&] { return !alone->busy(); }, 60'000);
  }
  take("camera_dialog", QStringLiteral("camera-alone"));
  test::trigger(window, "print_board");
  take("print_dialog", QStringLiteral("print"));
  photograph_plan(window, camera, theme);
  photograph_watch(window, camera, theme);
  test::trigger(window, "guide");
  take("guide_dialog", QStringLiteral("guide"));
  test::trigger(window, "about");
  take("about_dialog", QStringLiteral("about"));
  // A question as its user gets it; tests answer others.
  QTimer::singleShot(500, &window, [&] {
    QWidget* question = QApplication::activeModalWidget();
    if (question == nullptr) return;
    camera.take(QStringLiteral("failed-") + theme, question);
    question->close();
  });
  widgets::Choices().hand_on_failed(&window);
  window.open(QStringLiteral("/nowhere/rig"));
  test::wait_until([&] { return test::find<QDialog>(window, "error_dialog") != nullptr; }, 5000);
  take("error_dialog", QStringLiteral("error"));
}

// A walk with four poses, the first of which is taken up again.
void photograph_import(widgets::MainWindow& window, Photographer& camera) {
  test::RecordedWalk walk(test::walk_simulation(4, 60'000, 960, 600));
  simulation::SimulatedRig rig = walk.rig;
  rig.scenes.push_back(rig.scenes.front());
  rig.scenes.back().name = "again";
  test::WalkOptions options;
  options.moving_ticks = 12;
  window.open(walk.write(test::simulated_walk(rig, options), QStringLiteral("parking-lot.bag")));
  auto* dialog = test::find<QDialog>(window, "import_dialog");
  auto* stretches = test::find<widgets::StretchList>(*dialog, "stretches");
  test::wait_until([&] { return stretches->topLevelItemCount() > 0; });
  test::wait_until([&] { return !stretches->topLevelItem(3)->text(3).isEmpty(); }, 20'000);
  stretches->setCurrentItem(stretches->topLevelItem(1));
  for (const char* theme : {"light", "dark"}) {
    choose(window, "theme", QString::fromLatin1(theme));
    camera.take(QStringLiteral("import-%1").arg(QLatin1String(theme)), dialog);
  }
  choose(window, "theme", QStringLiteral("light"));
  dialog->close();
}

// A simulated rig's files as others keep them, one cloud without its image.
void photograph_files(widgets::MainWindow& window, Photographer& camera) {
  const auto rig = simulation::simulate(test::walk_simulation(4, 60'000, 960, 600), {});
  const QTemporaryDir folder;
  const QDir source(folder.filePath(QStringLiteral("source")));
  const QDir files(folder.filePath(QStringLiteral("parking-lot")));
  if (!rig || !simulation::write_dataset(*rig, source.path().toStdString()).ok()) return;
  for (const char* part : {"images", "clouds"}) files.mkpath(QLatin1String(part));
  QFile::copy(source.filePath(QStringLiteral("camera.yaml")),
              files.filePath(QStringLiteral("camera.yaml")));
  for (const simulation::SimulatedScene& scene : rig->scenes) {
    const QString name = QString::fromStdString(scene.name);
    const auto copy = [&](const QString& file, const QString& to) {
      QFile::copy(source.filePath(QStringLiteral("scenes/%1/%2").arg(name, file)),
                  files.filePath(to));
    };
    if (&scene != &rig->scenes.back())
      copy(QStringLiteral("image.png"), QStringLiteral("images/%1.png").arg(name));
    copy(QStringLiteral("cloud.pcd"), QStringLiteral("clouds/%1.pcd").arg(name));
  }
  window.open(files.path());
  auto* dialog = test::find<QDialog>(window, "files_dialog");
  auto* pairs = test::find<QTreeWidget>(*dialog, "pairs");
  test::wait_until([&] { return pairs->topLevelItemCount() > 0; });
  test::wait_until([&] { return !pairs->topLevelItem(2)->text(4).isEmpty(); }, 20'000);
  for (const char* theme : {"light", "dark"}) {
    choose(window, "theme", QString::fromLatin1(theme));
    camera.take(QStringLiteral("files-%1").arg(QLatin1String(theme)), dialog);
  }
  choose(window, "theme", QStringLiteral("light"));
  dialog->close();
}

bool wait_for_model(widgets::MainWindow& window) {
  return test::wait_until([&] { return window.model_work().step() && !window.model_work().busy(); },
                          600'000);
}

// The Model page from the first look to the fallen error, and everything that it can show.
void photograph_model(widgets::MainWindow& window, Photographer& camera, const QString& theme) {
  const auto name = [&](const char* state) {
    return QStringLiteral("model-%1-%2").arg(QLatin1String(state), theme);
  };
  window.model_work().go_to(0);
  if (!wait_for_model(window)) return;
  auto* where = test::find<QTabWidget>(window, "where_tabs");
  camera.take(name("missing"));
  auto* missing_tabs = test::find<QTreeWidget>(window, "sensitivity");
  auto* right = qobject_cast<QTabWidget*>(missing_tabs->parentWidget()->parentWidget());
  if (right != nullptr) {
    right->setCurrentIndex(1);
    camera.take(name("unseen"));
    right->setCurrentIndex(0);
  }
  auto* along = test::find<QComboBox>(window, "covariate");
  const QVariant watched = along->currentData();
  auto* effect = test::find<QComboBox>(window, "what_if_effect");
  effect->setCurrentIndex(effect->findData(QStringLiteral("range_cyclic")));
  camera.take(name("what-if"));
  effect->setCurrentIndex(0);
  // What the addition will make fall.
  along->setCurrentIndex(along->findData(watched));
  test::find<QPushButton>(window, "add_effect")->click();
  if (auto* dialog = test::find<QDialog>(window, "add_effect_dialog")) {
    camera.take(name("add"), dialog);
    for (auto* tabs : dialog->findChildren<QTabWidget*>()) tabs->setCurrentIndex(1);
    camera.take(name("formula"), dialog);
    dialog->close();
  }
  if (window.model_work().steps().size() > 1) {
    window.model_work().go_to(1);
  } else {
    test::find<QPushButton>(window, "add_proposal")->click();
    test::wait_until([&] { return window.model_work().current() == 1; }, 600'000);
  }
  if (!wait_for_model(window)) return;
  camera.take(name("added"));
  auto* channel = test::find<QComboBox>(window, "channel");
  const char* const maps[] = {"residuals", "image", "board", "directions", "intensity"};
  for (int tab = 1; tab < where->count(); ++tab) {
    const Channel shown = tab == 1 ? Channel::kCorner : Channel::kRange;
    channel->setCurrentIndex(channel->findData(static_cast<int>(shown)));
    where->setCurrentIndex(tab);
    camera.take(name(maps[tab]));
  }
  where->setCurrentIndex(0);
  auto* plot = test::find<widgets::ResidualPlot>(window, "residual_plot");
  test::find<QToolButton>(window, "brush")->click();
  QTest::qWait(800);
  if (plot->figure()) {
    const auto& f = *plot->figure();
    Q_EMIT plot->brushed(QRectF(QPointF(f.x_low, 0.4 * f.y_high), QPointF(f.x_high, f.y_high)));
  }
  camera.take(name("brush"));
  test::find<QTabWidget>(window, "pages")->setCurrentIndex(0);
  QTest::qWait(1500);
  camera.take(name("brush-scene"));
  test::find<QTabWidget>(window, "pages")->setCurrentIndex(4);
  test::find<QToolButton>(window, "brush")->click();
  // All that the search finds, from the base model.
  window.model_work().go_to(0);
  if (!wait_for_model(window)) return;
  channel->setCurrentIndex(channel->findData(static_cast<int>(Channel::kRange)));
  test::find<QPushButton>(window, "find_all")->click();
  if (wait_for_model(window)) camera.take(name("all"));
  // Two effects with long names and many parameters.
  window.model_work().go_to(0);
  for (const char* effect : {"intensity_geometry", "range_incidence"}) {
    if (!wait_for_model(window)) return;
    window.model_work().add(QString::fromLatin1(effect));
  }
  if (wait_for_model(window)) camera.take(name("two"));
  // What the rest is taken with.
  window.model_work().go_to(0);
  if (!wait_for_model(window)) return;
  window.model_work().add(QStringLiteral("range_walk"));
  wait_for_model(window);
}

// Every bubble as its reader finds it, up to the one that waits for an effect to be added.
void photograph_tour(widgets::MainWindow& window, Photographer& camera) {
  auto* coach = test::find<widgets::CoachMarks>(window, "coach_marks");
  auto* next = test::find<QPushButton>(window, "coach_next");
  while (coach != nullptr && next != nullptr && coach->isVisible()) {
    camera.take(QStringLiteral("tour-%1").arg(coach->current() + 1));
    if (!next->isVisible() || !next->isEnabled()) break;
    next->click();
  }
  if (auto* close = test::find<QPushButton>(window, "coach_close")) close->click();
}

// The tour once more, to its end: after it the model is another one.
void photograph_last_bubble(widgets::MainWindow& window, Photographer& camera) {
  test::trigger(window, "demo");
  test::wait_until([&] { return window.workspace().result() == nullptr; }, 60'000);
  test::wait_until([&] { return window.workspace().is_open() && !window.workspace().busy(); });
  test::trigger(window, "run");
  if (!test::wait_for_result(window)) return;
  test::find<QTabWidget>(window, "pages")->setCurrentIndex(4);
  if (!wait_for_model(window)) return;
  auto* coach = test::find<widgets::CoachMarks>(window, "coach_marks");
  auto* next = test::find<QPushButton>(window, "coach_next");
  if (coach == nullptr || next == nullptr) return;
  // The bubble looks every fifth of a second whether what it waits for is there.
  const auto can_go_on = [next] { return next->isVisible() && next->isEnabled(); };
  while (test::wait_until(can_go_on, 2'000)) {
    next->click();
    QTest::qWait(300);
  }
  const int waiting = coach->current();
  test::find<QPushButton>(window, "add_proposal")->click();
  test::wait_until([&] { return coach->current() != waiting; }, 600'000);
  if (wait_for_model(window)) camera.take(QStringLiteral("tour-%1").arg(coach->current() + 1));
}

// A post before a board: what is refused, and with all of it used all the same.
int photograph_covered(widgets::MainWindow& window, Photographer& camera, const QString& theme) {
  const QTemporaryDir folder;
  const QString dataset = folder.filePath(QStringLiteral("covered"));
  auto rig = simulation::simulate(widgets::demo_options(), {});
  if (!rig) return 1;
  BoardOutline post = rig->target.outline();
  post.lower_left_m += Eigen::Vector2d(0.57, -0.05);
  post.upper_right_m = post.lower_left_m + Eigen::Vector2d(0.06, 0.62);
  test::cover_part(*rig, 1, post, 0.06F);
  if (!simulation::write_dataset(*rig, dataset.toStdString()).ok()) return 1;
  window.open(dataset);
  if (!test::wait_until([&] { return window.workspace().is_open(); })) return 1;
  test::trigger(window, "run");
  if (!test::wait_for_result(window)) return 1;
  choose(window, "theme", theme);
  auto* tabs = test::find<QTabWidget>(window, "pages");
  const auto take = [&](const char* state) {
    const auto name = [&](const char* part) {
      return QStringLiteral("%1%2-%3").arg(QLatin1String(state), QLatin1String(part), theme);
    };
    test::click_scene(window, QStringLiteral("B"), false);
    tabs->setCurrentIndex(0);
    tabs->currentWidget()->findChild<widgets::CloudView*>()->look(widgets::CloudViewpoint::kBoard);
    QTest::qWait(1500);
    camera.take(name(""));
    tabs->setCurrentIndex(1);
    camera.take(name("-refinement"));
    tabs->setCurrentIndex(3);
    tabs->currentWidget()->findChild<QTabWidget*>()->setCurrentIndex(2);
    camera.take(name("-list"));
  };
  take("covered");
  SceneEdits edits;
  for (const Refusal& refusal : refusals(*window.workspace().result())) {
    if (refusal.scene == "B") keep(edits, refusal);
  }
  window.workspace().set_edits({{QStringLiteral("B"), edits}});
  if (!test::wait_for_result(window)) return 1;
  take("kept");
  return 0;
}

int photograph(widgets::MainWindow& window, const QString& folder, const QString& dataset,
               const QString& what, const QString& quick_theme) {
  const bool quick = !what.isEmpty();
  Photographer camera(window, folder);
  window.move(0, 0);
  window.show();
  if (what == QLatin1String("covered")) return photograph_covered(window, camera, quick_theme);
  camera.take(QStringLiteral("welcome"));
  if (!quick) {
    photograph_import(window, camera);
    photograph_files(window, camera);
  }
  if (dataset.isEmpty()) {
    test::trigger(window, "demo");
  } else {
    window.open(dataset);
  }
  if (!test::wait_until([&] { return window.workspace().is_open(); })) return 1;
  if (!test::wait_until([&] { return !window.workspace().busy(); })) return 1;
  camera.take(QStringLiteral("opened"));
  if (what == QLatin1String("opened")) {
    test::trigger(window, "run");
    test::wait_until([&] { return !window.workspace().busy(); });
    camera.take(QStringLiteral("opened-2"));
    return 0;
  }
  test::trigger(window, "run");
  QTest::qWait(150);  // The demo is done in less than a second.
  camera.take_at_once(QStringLiteral("running"));
  if (!test::wait_until(
          [&] { return window.workspace().result() != nullptr && !window.workspace().busy(); }))
    return 1;
  auto* tabs = test::find<QTabWidget>(window, "pages");
  tabs->setCurrentIndex(4);
  camera.take(QStringLiteral("model-looking"));
  wait_for_model(window);
  photograph_tour(window, camera);
  if (quick) {
    choose(window, "theme", quick_theme);
    if (what == QLatin1String("model")) {
      photograph_model(window, camera, quick_theme);
      return 0;
    }
    photograph_pages(window, camera, quick_theme);
    photograph_refused(window, camera, quick_theme);
    photograph_left_out(window, camera, quick_theme);
    photograph_dialogs(window, camera, quick_theme);
    return 0;
  }
  for (const char* theme : {"light", "dark"}) {
    choose(window, "theme", QString::fromLatin1(theme));
    photograph_pages(window, camera, QString::fromLatin1(theme));
    photograph_refused(window, camera, QString::fromLatin1(theme));
    tabs->setCurrentIndex(4);
    photograph_model(window, camera, QLatin1String(theme));
    photograph_dialogs(window, camera, QString::fromLatin1(theme));
    photograph_left_out(window, camera, QString::fromLatin1(theme));
  }
  choose(window, "theme", QStringLiteral("light"));
  if (dataset.isEmpty()) photograph_last_bubble(window, camera);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(3, 2);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(24);
  QSurfaceFormat::setDefaultFormat(format);
  QApplication application(argc, argv);
  const QStringList arguments = QApplication::arguments();
  if (arguments.size() < 2) {
    std::fprintf(stderr,
                 "usage: lvcalib-screenshots FOLDER [DATASET|demo] [LANGUAGE] [WIDTHxHEIGHT] "
                 "[quick|model|opened|covered [dark]]\n");
    return 2;
  }
  QDir().mkpath(arguments.at(1));
  QTemporaryDir settings_folder;
  widgets::AppSettings settings(settings_folder.path());
  widgets::apply_theme(application, widgets::Theme::kLight);
  test::Answers answers;
  int status = 0;
  {
    widgets::MainWindow window(settings, answers);
    choose(window, "language", arguments.value(3, QStringLiteral("en")));
    const QString dataset = arguments.value(2);
    QString what;
    for (const char* part : {"quick", "model", "opened", "covered"}) {
      if (arguments.contains(QLatin1String(part))) what = QLatin1String(part);
    }
    const QStringList size = arguments.value(4).split(QLatin1Char('x'));
    if (size.size() == 2) window.resize(size[0].toInt(), size[1].toInt());
    status = photograph(window, arguments.at(1),
                        dataset == QLatin1String("demo") ? QString() : dataset, what,
                        arguments.contains(QLatin1String("dark")) ? QStringLiteral("dark")
                                                                  : QStringLiteral("light"));
  }
  widgets::Runner::wait_for_workers(10'000);
  return status;
}
