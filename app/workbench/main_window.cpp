// SPDX-License-Identifier: GPL-3.0-or-later
#include "workbench/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDir>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QMimeData>
#include <QScreen>
#include <QShortcut>
#include <QToolBar>
#include <algorithm>
#include <utility>

#include "dialogs/about_dialog.h"
#include "dialogs/error_dialog.h"
#include "dialogs/guide_dialog.h"
#include "docks/log_dock.h"
#include "docks/parameters_dock.h"
#include "docks/scenes_dock.h"
#include "modelling/model_page.h"
#include "pages/extrinsic_page.h"
#include "pages/threshold_pane.h"
#include "pipeline/refusals.h"
#include "report/result_file.h"
#include "runner/demo.h"
#include "start/welcome_page.h"
#include "tools/watch_window.h"
#include "words/core_text.h"
#include "workbench/demo_tour.h"
#include "workbench/main_actions.h"
#include "workbench/page_stack.h"
#include "workbench/result_actions.h"
#include "workbench/status_line.h"

namespace lvcalib::widgets {
namespace {

// Files and folders of this machine; none if anything else is among them.
QStringList dropped_paths(const QMimeData& data) {
  QStringList paths;
  for (const QUrl& url : data.urls()) {
    if (!url.isLocalFile()) return {};
    paths << url.toLocalFile();
  }
  return paths;
}

}  // namespace

MainWindow::MainWindow(AppSettings& settings, Choices& choices, QWidget* parent)
    : QMainWindow(parent),
      settings_(settings),
      choices_(choices),
      demo_(demo_options()),
      workspace_(std::make_unique<Workspace>(settings.data_folder())),
      model_work_(std::make_unique<ModelWork>(*workspace_)),
      preview_(std::make_unique<PreviewWork>(*workspace_)),
      watch_(std::make_unique<WatchWork>(*workspace_)),
      actions_(new MainActions(*this, workspace_->undo_stack())),
      scenes_(new ScenesDock(model_, this)),
      parameters_(new ParametersDock(this)),
      log_(new LogDock(this)),
      pages_(new PageStack(this)),
      status_(new StatusLine(this)),
      results_(new ResultActions(choices, settings, *this)) {
  setObjectName(QStringLiteral("main_window"));
  pages_->add_pages(*model_work_, choices_);
  setAcceptDrops(true);
  setCentralWidget(pages_);
  setStatusBar(status_);
  addDockWidget(Qt::LeftDockWidgetArea, scenes_);
  addDockWidget(Qt::LeftDockWidgetArea, parameters_);
  addDockWidget(Qt::BottomDockWidgetArea, log_);
  // Both are there when asked for; the pages need the room more.
  parameters_->hide();
  log_->hide();
  actions_->add_view_toggles({scenes_->toggleViewAction(), parameters_->toggleViewAction(),
                              log_->toggleViewAction(), actions_->tool_bar->toggleViewAction()});
  connect_actions();
  actions_->follow(settings_);
  connect_docks();
  connect_workspace();
  connect_pages();
  connect_preview();
  connect_results();
  connect_model();
  connect_import();
  connect_watch();
  restore_window();
  pages_->welcome().set_recent(settings_.recent());
  actions_->set_recent(settings_.recent());
  update_actions();
  update_title();
}

MainWindow::~MainWindow() {
  // Nothing may be told to parts that are already gone.
  delete watch_window_;  // It looks at both of these.
  watch_->disconnect(this);
  model_work_->disconnect(this);
  workspace_->disconnect(this);
  workspace_->undo_stack().disconnect(this);
  delete scenes_;  // Before the model that it shows; other children go after the members.
}

void MainWindow::restore_window() {
  QSize size(1500, 940);
  if (screen() != nullptr) size = size.boundedTo(screen()->availableSize());
  resize(size);
  const int dock = std::max(410, size.width() * 3 / 10);
  resizeDocks({scenes_, parameters_}, {dock, dock}, Qt::Horizontal);
  resizeDocks({log_}, {140}, Qt::Vertical);
  restoreGeometry(settings_.geometry());
  restoreState(settings_.window_state());
}

void MainWindow::connect_actions() {
  const auto on = [this](QAction* action, auto what) {
    connect(action, &QAction::triggered, this, what);
  };
  const auto open_dataset = [this] {
    const QString path = choices_.dataset_to_open(this, settings_.last_folder());
    if (!path.isEmpty()) open(path);
  };
  const auto open_project = [this] {
    const QString path = choices_.project_to_open(this, settings_.last_folder());
    if (!path.isEmpty()) open(path);
  };
  const auto demo = [this] {
    if (!may_drop_decisions()) return;
    demo_opening_ = true;
    workspace_->open_demo(demo_);
  };
  const auto guide = [this] {
    if (!guide_) guide_ = new GuideDialog(pages_->tab(), this);
    guide_->show_page(pages_->tab());
  };
  on(actions_->open_dataset, open_dataset);
  on(actions_->open_project, open_project);
  on(actions_->demo, demo);
  on(actions_->guide, guide);
  on(actions_->about, [this] { (new AboutDialog(this))->show(); });
  on(actions_->save, [this] { save(false); });
  on(actions_->save_as, [this] { save(true); });
  on(actions_->results, [this] { results_->show(final_result(), standing()); });
  on(actions_->report,
     [this] { results_->write_report(final_result(), model_work_->discovery()); });
  const auto target_camera = [this] {
    results_->edit_target_camera(workspace_->is_open()
                                     ? QString::fromStdString(workspace_->dataset().path.string())
                                     : QString());
  };
  on(actions_->target_camera, target_camera);
  on(actions_->camera_alone, [this] { results_->calibrate_camera(); });
  on(actions_->print_board, [this] {
    results_->print_board(workspace_->is_open() ? std::optional(workspace_->dataset().target)
                                                : std::nullopt);
  });
  on(actions_->correct, [this] { results_->correct_clouds(final_result()); });
  on(actions_->compare, [this] { compare(); });
  on(actions_->check, [this] { check(); });
  on(actions_->plan, [this] { plan_scenes(); });
  on(actions_->run, [this] { workspace_->run(); });
  on(actions_->cancel, [this] {
    workspace_->cancel();
    model_work_->cancel();
    preview_->cancel();
    results_->cancel();
  });
  on(actions_->use_crops, [this](bool use) { workspace_->set_use_crops(use); });
  connect(actions_, &MainActions::recent_wanted, this, &MainWindow::open);
  const WelcomePage& welcome = pages_->welcome();
  connect(&welcome, &WelcomePage::open_dataset_wanted, this, open_dataset);
  connect(&welcome, &WelcomePage::open_project_wanted, this, open_project);
  connect(&welcome, &WelcomePage::target_camera_wanted, this, target_camera);
  connect(&welcome, &WelcomePage::demo_wanted, this, demo);
  connect(&welcome, &WelcomePage::guide_wanted, this, guide);
  connect(&welcome, &WelcomePage::recent_wanted, this, &MainWindow::open);
  for (int tab = 0; tab < pages_->tab_count(); ++tab) {
    auto* keys = new QShortcut(QKeySequence(static_cast<int>(Qt::CTRL) | (Qt::Key_1 + tab)), this);
    connect(keys, &QShortcut::activated, this, [this, tab] { pages_->show_tab(tab); });
  }
}

void MainWindow::connect_docks() {
  connect(scenes_, &ScenesDock::scene_activated, this, &MainWindow::look_at);
  connect(scenes_, &ScenesDock::use_wanted, workspace_.get(), &Workspace::set_use);
  connect(scenes_, &ScenesDock::insist_wanted, workspace_.get(), &Workspace::set_insist);
  connect(scenes_, &ScenesDock::run_again_wanted, workspace_.get(), &Workspace::run_again);
  connect(scenes_, &ScenesDock::uncrop_wanted, this, [this](const QStringList& scenes) {
    for (const QString& scene : scenes) workspace_->set_crop(scene, std::nullopt);
  });
  connect(scenes_, &ScenesDock::note_wanted, workspace_.get(), &Workspace::set_note);
  connect(scenes_, &ScenesDock::order_wanted, workspace_.get(), &Workspace::set_scene_order);
  connect(scenes_, &ScenesDock::add_wanted, this,
          [this] { add_scenes(choices_.scenes_to_add(this, settings_.last_folder())); });
  connect(parameters_, &ParametersDock::option_wanted, workspace_.get(), &Workspace::set_option);
  connect(parameters_, &ParametersDock::reset_all_wanted, workspace_.get(),
          &Workspace::reset_options);
}

void MainWindow::add_scenes(const QStringList& folders) {
  if (folders.isEmpty()) return;
  if (Status s = workspace_->add_scene_folders(folders); !s) show_error(s.error());
}

void MainWindow::connect_workspace() {
  const Workspace* w = workspace_.get();
  connect(w, &Workspace::opened, this, &MainWindow::take_opened);
  connect(w, &Workspace::dataset_moved, this, [this](const QString& old_path) {
    const QString path = choices_.moved_dataset(this, old_path);
    if (!path.isEmpty()) workspace_->open_moved(path);
  });
  connect(w, &Workspace::decisions_changed, this, [this] {
    const Decisions& decisions = workspace_->decisions();
    model_.set_decisions(decisions);
    parameters_->set_options(decisions.options);
    const SceneDecision decision = decision_of(decisions, scene_.toStdString());
    pages_->set_crop_box(decision.crop);
    pages_->set_edits(decision.edits);
    actions_->use_crops->setChecked(decisions.use_crops);
    show_quality();
    update_actions();
  });
  connect(w, &Workspace::result_changed, this, &MainWindow::take_result);
  connect(w, &Workspace::run_started, this, [this] {
    status_->show_progress({}, 0.0, {});
    update_actions();
  });
  connect(w, &Workspace::progressed, status_, &StatusLine::show_progress);
  connect(w, &Workspace::board_found, pages_, &PageStack::show_board_points);
  connect(w, &Workspace::iterated, pages_, &PageStack::show_iteration);
  connect(w, &Workspace::run_ended, this, [this](const QString& message) {
    status_->show_idle(message);
    update_actions();
  });
  connect(w, &Workspace::failed, this, [this](const Error& error, bool modest) {
    run_when_opened_ = false;
    watch_next_.reset();
    if (modest) return;  // The status line says it.
    if (watch_->ranLast()) {
      // Nobody sits before the screen to close a message for every scene.
      log_->append(core_text(error));
    } else {
      show_failed(error);
    }
  });
  connect(w, &Workspace::logged, log_, [this](const QString& line) { log_->append(line); });
  connect(w, &Workspace::dirty_changed, this, &MainWindow::update_title);
}

void MainWindow::connect_pages() {
  connect(&loader_, &SceneLoader::thumbnail, &model_, &SceneModel::set_thumbnail);
  connect(&loader_, &SceneLoader::loaded, this,
          [this](const QString& scene, const SceneData& data) {
            if (data.image_problem.empty() && data.cloud_problem.empty())
              model_.set_problem(scene, {});
            if (scene == scene_) pages_->set_scene_data(data);
          });
  connect(&loader_, &SceneLoader::failed, this,
          [this](const QString& scene, const Message& message) {
            model_.set_problem(scene, message);
            log_->append(tr("Scene %1: %2").arg(scene, core_text(message)));
          });
  connect(pages_, &PageStack::crop_wanted, this,
          [this](int scene, const std::optional<CropBox>& box) {
            workspace_->set_crop(scene_name(scene), box);
          });
  connect(pages_, &PageStack::edits_wanted, this, [this](int scene, const SceneEdits& edits) {
    workspace_->set_edits({{scene_name(scene), edits}});
  });
  connect(pages_, &PageStack::keep_wanted, this, [this](const QString& scene, bool tag, int id) {
    SceneEdits edits = decision_of(workspace_->decisions(), scene.toStdString()).edits;
    (tag ? edits.kept_tags : edits.kept_circles).push_back(id);
    workspace_->set_edits({{scene, edits}});
  });
  connect(pages_, &PageStack::keep_patch_wanted, this, [this](const QString& scene, int id) {
    if (!workspace_->result()) return;
    SceneEdits edits = decision_of(workspace_->decisions(), scene.toStdString()).edits;
    for (const Refusal& refusal : refusals(*workspace_->result())) {
      if (refusal.scene == scene.toStdString() && refusal.what == Refusal::What::kPatch &&
          refusal.id == id)
        keep(edits, refusal);
    }
    workspace_->set_edits({{scene, edits}});
  });
  connect(pages_, &PageStack::kept_dropped, this, [this](const QString& scene) {
    SceneEdits edits = decision_of(workspace_->decisions(), scene.toStdString()).edits;
    edits.kept_tags.clear();
    edits.kept_circles.clear();
    edits.kept_patches.clear();
    workspace_->set_edits({{scene, edits}});
  });
  connect(pages_, &PageStack::taken_back, this,
          [this](const QString& scene, const SceneEdits& what) {
            SceneEdits edits = decision_of(workspace_->decisions(), scene.toStdString()).edits;
            std::erase_if(edits.tags, [&](int id) { return contains_id(what.tags, id); });
            std::erase_if(edits.circles, [&](int id) { return contains_id(what.circles, id); });
            std::erase_if(edits.patches_m, [&](const auto& patch) {
              return std::find(what.patches_m.begin(), what.patches_m.end(), patch) !=
                     what.patches_m.end();
            });
            workspace_->set_edits({{scene, edits}});
          });
  connect(pages_, &PageStack::measurements_excluded, this,
          [this](const std::map<QString, SceneEdits>& more) {
            std::map<QString, SceneEdits> edits;
            for (const auto& [scene, out] : more) {
              SceneEdits& edit = edits[scene];
              edit = decision_of(workspace_->decisions(), scene.toStdString()).edits;
              edit.points_m.insert(edit.points_m.end(), out.points_m.begin(), out.points_m.end());
              for (const int tag : out.tags) {
                if (!contains_id(edit.tags, tag)) edit.tags.push_back(tag);
              }
            }
            workspace_->set_edits(edits);
          });
  connect(pages_, &PageStack::scene_patch_excluded, this,
          [this](const QString& scene, const std::vector<Eigen::Vector2d>& patch) {
            SceneEdits edits = decision_of(workspace_->decisions(), scene.toStdString()).edits;
            edits.patches_m.push_back(patch);
            workspace_->set_edits({{scene, edits}});
          });
  connect(pages_, &PageStack::patch_excluded, this,
          [this](const std::vector<Eigen::Vector2d>& patch) {
            std::map<QString, SceneEdits> edits;
            for (const SceneFiles& files : workspace_->dataset().scenes) {
              SceneEdits& edit = edits[QString::fromStdString(files.name)];
              edit = decision_of(workspace_->decisions(), files.name).edits;
              edit.patches_m.push_back(patch);
            }
            workspace_->set_edits(edits);
          });
  connect(pages_, &PageStack::dataset_changed, this, [this] {
    if (Status s = workspace_->reread(); !s) {
      show_error(s.error());
    } else {
      pages_->set_dataset(workspace_->dataset());
    }
  });
  connect(pages_, &PageStack::insist_wanted, this,
          [this](int scene) { workspace_->set_insist({scene_name(scene)}, true); });
  connect(pages_, &PageStack::scene_wanted, this,
          [this](int scene) { scenes_->select(scene_name(scene)); });
  connect(pages_, &PageStack::failed, this, [this](const QString& message) {
    show_error(Error::output(Message::verbatim(message.toStdString())));
  });
}

// Thresholds of the solve: looked at first, then decided.
void MainWindow::connect_preview() {
  ThresholdPane* pane = pages_->thresholds();
  connect(pane, &ThresholdPane::previewWanted, this, [this, pane](double gate) {
    Decisions decisions = workspace_->decisions();
    decisions.options.extrinsic.rejection_gate = gate;
    scenes_preview_ = false;
    preview_->request(decisions);
    pane->setBusy();
  });
  connect(pane, &ThresholdPane::previewDropped, preview_.get(), &PreviewWork::cancel);
  connect(pane, &ThresholdPane::gateWanted, this, [this](double gate) {
    preview_->cancel();
    for (const OptionDeclaration& option : option_declarations()) {
      if (option.key == "extrinsic.rejection_gate") workspace_->set_option(option, gate);
    }
  });
  ExtrinsicPage* page = pages_->extrinsic_page();
  connect(page, &ExtrinsicPage::scenesPreviewWanted, this, [this](const QStringList& without) {
    Decisions decisions = workspace_->decisions();
    for (const QString& scene : without) decisions.scenes[scene.toStdString()].use = false;
    scenes_preview_ = true;
    preview_->request(decisions);
  });
  connect(page, &ExtrinsicPage::scenesPreviewDropped, this, [this] {
    if (scenes_preview_) preview_->cancel();
  });
  connect(page, &ExtrinsicPage::rejectWanted, this, [this](const QStringList& scenes) {
    preview_->cancel();
    workspace_->set_use(scenes, false);
  });
  connect(preview_.get(), &PreviewWork::ready, this,
          [this, pane, page](const auto& present, const auto& preview) {
            if (scenes_preview_) {
              page->setScenesPreview(*present, *preview);
            } else {
              pane->setPreview(*present, *preview);
            }
          });
  connect(preview_.get(), &PreviewWork::failed, this, [this, pane, page](const Error& error) {
    scenes_preview_ ? page->setScenesError(error) : pane->setError(error);
  });
}

void MainWindow::connect_results() {
  connect(results_, &ResultActions::failed, this, &MainWindow::show_error);
  connect(results_, &ResultActions::progressed, status_, &StatusLine::show_progress);
  connect(results_, &ResultActions::logged, log_, &LogDock::append);
  connect(results_, &ResultActions::busy_changed, this, &MainWindow::update_actions);
  connect(results_, &ResultActions::rough_pose_wanted, workspace_.get(), &Workspace::set_guess);
  workspace_->set_default_frames(
      {settings_.lidar_frame().toStdString(), settings_.camera_frame().toStdString()});
  connect(results_, &ResultActions::frames_changed, workspace_.get(),
          [this](const FrameNames& names) {
            workspace_->set_default_frames(names);
            workspace_->set_frames(names);
          });
  connect(results_, &ResultActions::done, this, [this](const QString& message) {
    if (!workspace_->busy()) status_->show_idle(message);
  });
}

void MainWindow::take_opened() {
  const Dataset& dataset = workspace_->dataset();
  results_->set_frames(workspace_->frames());
  const QString path = workspace_->project_path().isEmpty()
                           ? QString::fromStdString(dataset.path.string())
                           : workspace_->project_path();
  settings_.add_recent(path);
  settings_.set_last_folder(QFileInfo(path).absolutePath());
  actions_->set_recent(settings_.recent());
  pages_->welcome().set_recent(settings_.recent());
  model_.set_scenes(dataset, workspace_->missing_scenes());
  loader_.load_thumbnails(dataset.scenes);
  scene_.clear();
  pages_->start(dataset);
  read_truth_of(dataset);
  pages_->show_pages();
  if (!dataset.scenes.empty()) scenes_->select(scene_name(0));
  if (std::exchange(demo_opening_, false)) {
    start_tour();
  } else if (tour_ != nullptr) {
    tour_->end();
  }
  update_title();
  update_actions();
  if (std::exchange(run_when_opened_, false)) workspace_->run();
}

void MainWindow::read_truth_of(const Dataset& dataset) {
  std::filesystem::path path = truth_path_.toStdString();
  std::error_code code;
  if (path.empty()) {
    path = dataset.path;
    path += "-truth.json";
    if (!std::filesystem::exists(path, code)) return pages_->model_page()->setTruth(std::nullopt);
  }
  const auto truth = read_truth(path);
  pages_->model_page()->setTruth(truth ? std::optional(*truth) : std::nullopt);
  log_->append(truth ? tr("The distance to the truth is shown on the Model page: %1")
                           .arg(QString::fromStdString(path.string()))
                     : core_text(truth.error()));
}

void MainWindow::take_result() {
  pages_->model_page()->setReason({});
  show_result();
  // Files that could not be read when the scenes were loaded may have been mended since.
  const int shown = scene_index(scene_);
  if (!workspace_->result() || !model_.has_problems() || shown < 0) return;
  loader_.load(workspace_->dataset().scenes[static_cast<std::size_t>(shown)]);
  loader_.load_thumbnails(workspace_->dataset().scenes);
}

// Every page shows the result of the model in force.
void MainWindow::show_result() {
  const auto shown = final_result();
  model_.set_result(shown);
  pages_->set_result(shown);
  show_quality();
  update_actions();
}

void MainWindow::look_at(const QString& scene) {
  const int index = scene_index(scene);
  if (index < 0 || scene == scene_) return;
  scene_ = scene;
  const SceneDecision decision = decision_of(workspace_->decisions(), scene.toStdString());
  pages_->set_scene(index, decision.crop);
  pages_->set_edits(decision.edits);
  loader_.load(workspace_->dataset().scenes[static_cast<std::size_t>(index)]);
}

QString MainWindow::scene_name(int index) const {
  const auto& scenes = workspace_->dataset().scenes;
  if (index < 0 || static_cast<std::size_t>(index) >= scenes.size()) return {};
  return QString::fromStdString(scenes[static_cast<std::size_t>(index)].name);
}

int MainWindow::scene_index(const QString& name) const {
  const auto& scenes = workspace_->dataset().scenes;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    if (scenes[s].name == name.toStdString()) return static_cast<int>(s);
  }
  return -1;
}

void MainWindow::offer_recovery() {
  for (const Recovery& recovery : Autosave::find(settings_.data_folder())) {
    if (workspace_->is_open()) return;  // The others wait for the next start.
    if (choices_.recover(this, QString::fromStdString(recovery.project.dataset.string()))) {
      workspace_->open_recovery(recovery);
    } else {
      Autosave::discard(recovery);
    }
  }
}

bool MainWindow::may_drop_decisions() {
  if (!workspace_->dirty()) return true;
  const QString name =
      QFileInfo(QString::fromStdString(workspace_->dataset().path.string())).fileName();
  switch (choices_.unsaved(this, name)) {
    case UnsavedAnswer::kSave:
      return save(false);
    case UnsavedAnswer::kDiscard:
      return true;
    case UnsavedAnswer::kCancel:
      break;
  }
  return false;
}

bool MainWindow::save(bool ask_for_path) {
  if (!workspace_->is_open()) return false;
  QString path = workspace_->project_path();
  if (ask_for_path || path.isEmpty()) {
    const QString dataset = QString::fromStdString(workspace_->dataset().path.string());
    path =
        choices_.project_to_save(this, path.isEmpty() ? dataset + QLatin1String(".lvcalib") : path);
  }
  if (path.isEmpty()) return false;
  if (Status s = workspace_->save(path); !s) {
    show_error(s.error());
    return false;
  }
  settings_.add_recent(workspace_->project_path());
  actions_->set_recent(settings_.recent());
  update_title();
  return true;
}

ErrorDialog* MainWindow::show_error(const Error& error) {
  log_->append(core_text(error));
  auto* dialog = new ErrorDialog(error, this);
  dialog->show();
  return dialog;
}

// Where the folder itself is at fault, and none of the files in it, a dataset is still to be made.
void MainWindow::show_failed(const Error& error) {
  ErrorDialog* dialog = show_error(error);
  if (folder_wanted_.isEmpty() || error.where != folder_wanted_.toStdString()) return;
  settings_.set_last_folder(folder_wanted_);
  for (QAction* action : {actions_->import_recording, actions_->import_files})
    dialog->offer(*action);
}

void MainWindow::update_actions() {
  const bool open = workspace_->is_open();
  const bool busy = workspace_->busy();
  actions_->run->setEnabled(open && !busy);
  actions_->cancel->setEnabled(busy || results_->busy() || model_work_->busy());
  actions_->save->setEnabled(open);
  actions_->save_as->setEnabled(open);
  actions_->use_crops->setEnabled(open);
  actions_->check->setEnabled(open);
  actions_->watch_dataset->setEnabled(open);
  actions_->what_next->setEnabled(watch_->watching());
  // Not while the model in force is behind: what would be handed on is of another.
  const bool whole = workspace_->result() != nullptr && !model_work_->behind();
  for (QAction* action :
       {actions_->results, actions_->report, actions_->correct, actions_->compare})
    action->setEnabled(whole);
  parameters_->widget()->setEnabled(open);
}

void MainWindow::update_title() {
  QString name = QFileInfo(workspace_->project_path()).completeBaseName();
  if (name.isEmpty())
    name = QFileInfo(QString::fromStdString(workspace_->dataset().path.string())).fileName();
  const QString program = tr("LV-Calib Workbench");
  setWindowTitle(name.isEmpty() ? program : QStringLiteral("%1[*] – %2").arg(name, program));
  setWindowModified(workspace_->dirty());
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!may_drop_decisions()) {
    event->ignore();
    return;
  }
  settings_.set_window(saveGeometry(), saveState());
  watch_->stop();
  workspace_->cancel();
  model_work_->cancel();
  results_->cancel();
  loader_.clear();
  event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  const QStringList paths = dropped_paths(*event->mimeData());
  if (!paths.isEmpty()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  const QStringList paths = dropped_paths(*event->mimeData());
  if (paths.isEmpty()) return;
  event->acceptProposedAction();
  if (paths.size() == 1) {
    open(paths.first());
  } else if (workspace_->is_open()) {
    add_scenes(paths);  // Several are scenes for what is open.
  } else {
    status_->show_idle(
        tr("Several at once are added as scenes to what is open, and nothing is open yet: drop one "
           "folder, project or recording first."));
  }
}

void MainWindow::changeEvent(QEvent* event) {
  if (event->type() == QEvent::LanguageChange) {
    actions_->retranslate();
    update_title();
    if (!workspace_->busy()) status_->show_idle({});  // What it said was in the other language.
    show_quality();
  } else if (event->type() == QEvent::PaletteChange && actions_ != nullptr) {
    actions_->repaint_icons(palette());
  }
  QMainWindow::changeEvent(event);
}

}  // namespace lvcalib::widgets

#include "moc_main_window.cpp"
