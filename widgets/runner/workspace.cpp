// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/workspace.h"

#include <QDir>
#include <algorithm>
#include <utility>

#include "report/exports.h"
#include "runner/demo.h"
#include "runner/run_story.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

std::filesystem::path absolute_path(const QString& path) {
  return {QDir::cleanPath(QDir::current().absoluteFilePath(path)).toStdString()};
}

}  // namespace

// What opening something found.
struct Workspace::Opening {
  Project project;
  OpenedProject opened;
  QString project_path;
  bool unsaved = false;
  std::vector<Message> warnings;
};

Workspace::Workspace(const QString& data_folder, QObject* parent)
    : QObject(parent), data_folder_(data_folder), autosave_(data_folder) {
  settle_.setSingleShot(true);
  connect(&settle_, &QTimer::timeout, this, &Workspace::bring_up_to_date);
  connect(&runner_, &Runner::progressed, this,
          [this](quint64, const QString& stage, double fraction, const QString& text) {
            Q_EMIT progressed(stage, fraction, text);
          });
  connect(&runner_, &Runner::cancelled, this, [this] {
    Q_EMIT logged(tr("Cancelled."));
    Q_EMIT run_ended(tr("Cancelled"));
  });
  connect(&runner_, &Runner::failed, this, [this](quint64, const QString& message) {
    Q_EMIT run_ended(tr("Failed"));
    Q_EMIT failed(Runner::unexpected(message, dataset_.path.string(),
                                     Message("what was open is still there; try again")),
                  false);
  });
  // After the stack has moved: while a command runs, it still has its old index.
  connect(&undo_, &QUndoStack::indexChanged, this, [this] {
    set_dirty(!undo_.isClean() || unsaved_recovery_ || unsaved_frames_);
    keep_or_clear_autosave();
  });
  connect(&autosave_, &Autosave::written, this, [this] {
    if (taken_up_ && taken_up_->file != autosave_.file()) Autosave::discard(*taken_up_);
    taken_up_.reset();
  });
  connect(&autosave_, &Autosave::failed, this,
          [this](const QString& message) { Q_EMIT logged(tr("Autosave: %1").arg(message)); });
}

Workspace::~Workspace() {
  undo_.disconnect(this);
}

Project Workspace::project() const {
  return {dataset_.path, decisions_, model_, ProjectFrames{frames_.lidar, frames_.camera}};
}

void Workspace::set_frames(const FrameNames& names) {
  if (names == frames_) return;
  frames_ = names;
  unsaved_frames_ = true;
  set_dirty(true);
  keep_or_clear_autosave();
}

void Workspace::start(const Runner::Work& work) {
  runner_.abandon();
  runner_.start(work);
  Q_EMIT run_started();
}

void Workspace::open_in_background(const Runner::Work& work) {
  settle_.stop();
  start(work);
}

void Workspace::open_dataset(const QString& path) {
  open_in_background([this, folder = absolute_path(path)](const RunContext&, const Runner::Post&) {
    auto dataset = lvcalib::open_dataset(folder, UnusableScenes::kLeaveOut);
    return Runner::Deliver([this, dataset = std::move(dataset)] {
      Q_EMIT run_ended(QString());
      if (!dataset) {
        Q_EMIT failed(dataset.error(), false);
        return;
      }
      Opening opening;
      opening.opened.dataset = *dataset;
      opening.project.dataset = dataset->path;
      take_opened(std::move(opening));
    });
  });
}

void Workspace::open_project(const QString& path) {
  open_in_background([this, path](const RunContext&, const Runner::Post&) -> Runner::Deliver {
    const auto report = [this](const Error& error) {
      return [this, error] {
        Q_EMIT run_ended(QString());
        Q_EMIT failed(error, false);
      };
    };
    auto file = read_project(absolute_path(path));
    if (!file) return report(file.error());
    Opening opening;
    opening.project = file->project;
    opening.warnings = file->warnings;
    opening.project_path = QString::fromStdString(absolute_path(path).string());
    auto opened = open_project_dataset(opening.project);
    if (!opened) return report(opened.error());
    opening.opened = std::move(*opened);
    return [this, opening] {
      Q_EMIT run_ended(QString());
      take_opened(opening);
    };
  });
}

void Workspace::open_recovery(const Recovery& recovery) {
  Opening opening;
  opening.project = recovery.project;
  opening.project_path = recovery.project_path;
  opening.unsaved = true;
  auto opened = open_project_dataset(opening.project);
  if (!opened) {
    Q_EMIT failed(opened.error(), false);
    return;
  }
  opening.opened = std::move(*opened);
  taken_up_ = recovery;
  take_opened(std::move(opening));
}

void Workspace::open_moved(const QString& dataset_path) {
  if (!waiting_) return;
  Opening opening = std::move(*waiting_);
  waiting_.reset();
  opening.project.dataset = absolute_path(dataset_path);
  opening.unsaved = true;  // The file still has the old place.
  auto opened = open_project_dataset(opening.project);
  if (!opened) {
    Q_EMIT failed(opened.error(), false);
    return;
  }
  opening.opened = std::move(*opened);
  take_opened(std::move(opening));
}

void Workspace::open_demo(const simulation::SimulationOptions& options) {
  const std::filesystem::path folder = absolute_path(data_folder_) / "demo";
  open_in_background([this, folder, options](const RunContext& context, const Runner::Post&) {
    Status made = make_demo(folder, options, context);
    return Runner::Deliver([this, folder, made] {
      if (!made) {
        if (made.error().kind == ErrorKind::kCancelled) return;
        Q_EMIT run_ended(QString());
        Q_EMIT failed(made.error(), false);
        return;
      }
      Q_EMIT run_ended(QString());
      // Not within the delivery, whose job is just ending.
      QTimer::singleShot(0, this,
                         [this, folder] { open_dataset(QString::fromStdString(folder.string())); });
    });
  });
}

void Workspace::take_opened(Opening opening) {
  for (const auto* list :
       {&opening.warnings, &opening.opened.warnings, &opening.opened.dataset.warnings}) {
    for (const Message& warning : *list) Q_EMIT logged(core_text(warning));
  }
  if (opening.opened.dataset_moved) {
    const QString path = QString::fromStdString(opening.project.dataset.string());
    waiting_ = std::make_unique<Opening>(std::move(opening));
    Q_EMIT dataset_moved(path);
    return;
  }
  dataset_ = std::move(opening.opened.dataset);
  decisions_ = std::move(opening.project.decisions);
  model_ = std::move(opening.project.model);
  frames_ = default_frames_;
  // Names that no export takes are as good as none.
  if (const auto& named = opening.project.frames;
      named && check_frame_name(named->lidar) && check_frame_name(named->camera))
    frames_ = {named->lidar, named->camera};
  project_path_ = opening.project_path;
  missing_.clear();
  for (const std::string& name : opening.opened.missing_scenes)
    missing_ << QString::fromStdString(name);
  state_ = {};
  up_to_date_ = false;
  unsaved_frames_ = false;
  undo_.clear();
  unsaved_recovery_ = opening.unsaved;
  set_dirty(opening.unsaved);
  keep_or_clear_autosave();
  Q_EMIT logged(tr("Opened %1 with %n scenes.", nullptr, static_cast<int>(dataset_.scenes.size()))
                    .arg(QString::fromStdString(dataset_.path.string())));
  Q_EMIT opened();
  Q_EMIT decisions_changed();
  Q_EMIT result_changed();
}

Status Workspace::save(const QString& path) {
  const QString absolute = QString::fromStdString(absolute_path(path).string());
  if (Status s = write_project(absolute_path(path), project()); !s) return s;
  project_path_ = absolute;
  if (taken_up_) Autosave::discard(*taken_up_);
  taken_up_.reset();
  unsaved_recovery_ = false;
  unsaved_frames_ = false;
  undo_.setClean();
  set_dirty(false);
  keep_or_clear_autosave();
  Q_EMIT logged(tr("Saved %1.").arg(absolute));
  return Done{};
}

void Workspace::set_use(const QStringList& scenes, bool use) {
  Decisions after = decisions_;
  bool any = false;
  for (const QString& scene : scenes) {
    if (decision_of(decisions_, scene.toStdString()).use == use) continue;
    after.scenes[scene.toStdString()].use = use;
    any = true;
  }
  if (!any) return;
  decide({use ? QT_TRANSLATE_NOOP("Decisions", "accept %1")
              : QT_TRANSLATE_NOOP("Decisions", "reject %1"),
          scenes.join(QStringLiteral(", "))},
         std::move(after));
}

void Workspace::set_insist(const QStringList& scenes, bool insist) {
  Decisions after = decisions_;
  bool any = false;
  for (const QString& scene : scenes) {
    if (decision_of(decisions_, scene.toStdString()).insist == insist) continue;
    after.scenes[scene.toStdString()].insist = insist;
    any = true;
  }
  if (!any) return;
  decide({insist ? QT_TRANSLATE_NOOP("Decisions", "use %1 all the same")
                 : QT_TRANSLATE_NOOP("Decisions", "no longer use %1 all the same"),
          scenes.join(QStringLiteral(", "))},
         std::move(after));
}

void Workspace::set_edits(const std::map<QString, SceneEdits>& edits) {
  Decisions after = decisions_;
  QStringList changed;
  for (const auto& [scene, edit] : edits) {
    if (decision_of(decisions_, scene.toStdString()).edits == edit) continue;
    after.scenes[scene.toStdString()].edits = edit;
    changed << scene;
  }
  if (changed.isEmpty()) return;
  decide({QT_TRANSLATE_NOOP("Decisions", "choose measurements of %1"),
          changed.join(QStringLiteral(", "))},
         std::move(after));
}

void Workspace::set_note(const QString& scene, const QString& note) {
  if (decision_of(decisions_, scene.toStdString()).note == note.toStdString()) return;
  Decisions after = decisions_;
  after.scenes[scene.toStdString()].note = note.toStdString();
  decide({QT_TRANSLATE_NOOP("Decisions", "note on %1"), scene}, std::move(after),
         QStringLiteral("note ") + scene);
}

void Workspace::set_scene_order(const QStringList& scenes) {
  Decisions after = decisions_;
  after.scene_order.clear();
  for (const QString& scene : scenes) after.scene_order.push_back(scene.toStdString());
  if (after.scene_order == decisions_.scene_order) return;
  decide({QT_TRANSLATE_NOOP("Decisions", "order scenes"), {}}, std::move(after));
}

void Workspace::set_crop(const QString& scene, const std::optional<CropBox>& box) {
  if (box) {
    if (Status s = check(*box); !s) {
      Q_EMIT failed(s.error(), false);
      return;
    }
  }
  if (decision_of(decisions_, scene.toStdString()).crop == box) return;
  Decisions after = decisions_;
  after.scenes[scene.toStdString()].crop = box;
  decide({box ? QT_TRANSLATE_NOOP("Decisions", "crop %1")
              : QT_TRANSLATE_NOOP("Decisions", "uncrop %1"),
          scene},
         std::move(after), box ? QStringLiteral("crop ") + scene : QString());
}

void Workspace::set_option(const OptionDeclaration& option, double value) {
  if (option.get(decisions_.options) == value) return;
  Decisions after = decisions_;
  if (Status s = lvcalib::set_option(after.options, option.key, value); !s) {
    Q_EMIT failed(s.error(), false);
    return;
  }
  decide({QT_TRANSLATE_NOOP("Decisions", "change %1"), {}, option_name(option)}, std::move(after),
         QString::fromStdString(option.key));
}

void Workspace::reset_options() {
  if (same_options(decisions_.options, CalibrationOptions{})) return;
  Decisions after = decisions_;
  after.options = CalibrationOptions{};
  decide({QT_TRANSLATE_NOOP("Decisions", "reset all parameters"), {}}, std::move(after));
}

void Workspace::set_use_crops(bool use) {
  if (decisions_.use_crops == use) return;
  Decisions after = decisions_;
  after.use_crops = use;
  decide({use ? QT_TRANSLATE_NOOP("Decisions", "use board.pcd files")
              : QT_TRANSLATE_NOOP("Decisions", "use whole clouds"),
          {}},
         std::move(after));
}

void Workspace::set_guess(const std::optional<Rigid3>& camera_from_lidar) {
  Decisions after = decisions_;
  after.guess = camera_from_lidar;
  decide({camera_from_lidar ? QT_TRANSLATE_NOOP("Decisions", "take a rough pose by hand")
                            : QT_TRANSLATE_NOOP("Decisions", "forget the rough pose"),
          {}},
         std::move(after));
}

Status Workspace::add_scene_folders(const QStringList& folders) {
  std::vector<std::filesystem::path> paths;
  for (const QString& folder : folders) paths.push_back(absolute_path(folder));
  Dataset dataset = dataset_;
  if (Status s = add_scenes(dataset, paths); !s) return s;
  Decisions after = decisions_;
  after.added_scenes.insert(after.added_scenes.end(), paths.begin(), paths.end());
  QStringList names;
  for (const std::filesystem::path& path : paths)
    names << QString::fromStdString(path.filename().string());
  decide({QT_TRANSLATE_NOOP("Decisions", "add %1"), names.join(QStringLiteral(", "))},
         std::move(after));
  return Done{};
}

Status Workspace::take_new_scenes(const QStringList& folders) {
  std::vector<std::filesystem::path> paths;
  QStringList names;
  Dataset dataset = dataset_;
  for (const QString& folder : folders) {
    paths.push_back(absolute_path(folder));
    const std::string name = paths.back().filename().string();
    names << QString::fromStdString(name);
    // Listed as incomplete before.
    std::erase_if(dataset.scenes,
                  [&](const SceneFiles& files) { return files.problem && files.name == name; });
  }
  if (Status s = add_scenes(dataset, paths); !s) return s;
  dataset_ = std::move(dataset);
  for (const QString& name : names) missing_.removeAll(name);
  up_to_date_ = false;
  Q_EMIT logged(tr("New: scene %1").arg(names.join(QStringLiteral(", "))));
  Q_EMIT scenes_appeared(names);
  Q_EMIT decisions_changed();
  bring_up_to_date();
  return Done{};
}

Status Workspace::reread() {
  auto opened = open_project_dataset(project());
  if (!opened) return opened.error();
  if (opened->dataset_moved) return Done{};
  dataset_ = std::move(opened->dataset);
  up_to_date_ = false;
  Q_EMIT logged(tr("The dataset was read again"));
  Q_EMIT decisions_changed();
  if (state_.latest) bring_up_to_date();
  return Done{};
}

void Workspace::decide(DecisionCommand::Words words, Decisions after, const QString& merge_key) {
  undo_.push(new DecisionCommand([this](const Decisions& d) { apply(d); }, decisions_,
                                 std::move(after), std::move(words), merge_key));
}

void Workspace::apply(const Decisions& decisions) {
  const bool options_changed = !same_options(decisions.options, decisions_.options);
  const bool scenes_added = decisions.added_scenes != decisions_.added_scenes;
  const bool words_only = same_calibration(decisions, decisions_);
  decisions_ = decisions;
  if (words_only) {
    Q_EMIT decisions_changed();
    return;
  }
  if (scenes_added) {
    auto dataset = open_project_dataset(project());
    if (dataset && !dataset->dataset_moved) dataset_ = std::move(dataset->dataset);
    Q_EMIT opened();
  }
  up_to_date_ = false;
  Q_EMIT decisions_changed();
  if (state_.latest) schedule(options_changed ? kSettleMs : 0);
}

void Workspace::schedule(int delay_ms) {
  settle_.start(delay_ms);
}

void Workspace::run() {
  // Files that could not be read may have been mended since.
  bool unreadable = false;
  for (SceneFiles& files : dataset_.scenes) {
    if (!files.problem) continue;
    unreadable = true;
    if (auto again = open_scene(files.problem->where)) files = std::move(*again);
  }
  if (state_.whole) {
    for (const SceneResult& scene : state_.whole->scenes) unreadable |= scene.unreadable;
  }
  if (unreadable) state_.whole = nullptr;
  bring_up_to_date();
}

void Workspace::bring_up_to_date() {
  settle_.stop();
  if (!is_open()) return;
  start([this, dataset = dataset_, decisions = decisions_, state = state_](
            const RunContext& context, const Runner::Post& post) -> Runner::Deliver {
    CalibrationObserver observer;
    observer.board_points = [this, &post](std::size_t scene, const Cloud& points) {
      post([this, scene, copy = std::make_shared<const Cloud>(points)] {
        Q_EMIT board_found(static_cast<int>(scene), copy);
      });
    };
    observer.iteration = [this, &post](std::size_t scene, const BoardRefinement& so_far) {
      post([this, scene, copy = std::make_shared<const BoardRefinement>(so_far)] {
        Q_EMIT iterated(static_cast<int>(scene), copy);
      });
    };
    auto run =
        std::make_shared<SessionRun>(run_session(dataset, decisions, state, context, observer));
    return [this, run] { take_run(std::move(*run)); };
  });
}

void Workspace::take_run(SessionRun run) {
  const bool cancelled = run.error && run.error->kind == ErrorKind::kCancelled;
  const QString story = run.error ? QString() : run_story(state_, run);
  state_ = std::move(run.state);
  if (cancelled) return;  // The runner says so.
  if (run.error) {
    Q_EMIT logged(core_text(*run.error));
    Q_EMIT run_ended(tr("No result: %1").arg(core_text(run.error->message)));
    Q_EMIT failed(*run.error, run.solved_only);
    return;
  }
  up_to_date_ = true;
  const CalibrationResult& r = *state_.latest;
  // Nobody has looked for what is missing yet.
  const QString quality = r.quality == Quality::kGood       ? tr("good so far")
                          : r.quality == Quality::kDoubtful ? tr("doubtful")
                                                            : tr("failed");
  const QString line = tr("%1: %2 of %3 scenes, %4 px, %5 mm")
                           .arg(quality)
                           .arg(r.extrinsic.used_scenes)
                           .arg(r.scenes.size())
                           .arg(r.extrinsic.rms_px, 0, 'f', 3)
                           .arg(r.extrinsic.rms_mm, 0, 'f', 3);
  Q_EMIT logged(story);
  Q_EMIT logged(line);
  for (const Message& warning : r.warnings) Q_EMIT logged(warning_text(warning));
  Q_EMIT result_changed();
  Q_EMIT run_ended(line);
}

void Workspace::run_again(const QStringList& scenes) {
  for (const QString& scene : scenes) state_.cache.forget(scene.toStdString());
  state_.whole = nullptr;
  up_to_date_ = false;
  run();
}

void Workspace::cancel() {
  settle_.stop();
  runner_.cancel();
}

void Workspace::set_dirty(bool dirty) {
  if (dirty == dirty_) return;
  dirty_ = dirty;
  Q_EMIT dirty_changed(dirty);
}

void Workspace::keep_or_clear_autosave() {
  if (dirty_) {
    autosave_.keep(project(), project_path_);
  } else {
    autosave_.clear();
  }
}

}  // namespace lvcalib::widgets

#include "moc_workspace.cpp"
