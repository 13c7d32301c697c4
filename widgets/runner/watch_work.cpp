// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/watch_work.h"

#include <utility>

#include "pipeline/board_check.h"
#include "pipeline/scene_lister.h"
#include "runner/workspace.h"

namespace lvcalib::widgets {

// What one look gave.
struct WatchWork::Found {
  FolderWatch watch;  // As it is after the look.
  std::optional<Error> error;
  std::vector<PendingPair> pending;
  std::vector<std::filesystem::path> folders;  // Of complete scenes.
  std::vector<ImportedPair> refused;
};

WatchWork::WatchWork(Workspace& workspace, QObject* parent)
    : QObject(parent), workspace_(workspace) {
  timer_.setSingleShot(true);
  timer_.setInterval(kLook_ms);
  connect(&timer_, &QTimer::timeout, this, &WatchWork::look);
  connect(&runner_, &Runner::failed, this, [this](quint64, const QString& message) {
    Q_EMIT failed(Runner::unexpected(message));
    if (watching()) timer_.start();
  });
  connect(&workspace_, &Workspace::run_started, this, [this] { ran_last_ = false; });
  // Not within the delivery of a job that is just ending.
  connect(&workspace_, &Workspace::run_ended, this,
          [this] { QTimer::singleShot(0, this, &WatchWork::handOver); });
  connect(&workspace_, &Workspace::opened, this, [this] {
    if (watching() && workspace_.dataset().path != dataset_) stop();
  });
}

std::set<std::string> WatchWork::sceneNames() const {
  std::set<std::string> out;
  for (const SceneFiles& files : workspace_.dataset().scenes) {
    if (!files.problem) out.insert(files.name);
  }
  return out;
}

void WatchWork::watchScenes() {
  if (!workspace_.is_open()) return;
  stop();
  const std::filesystem::path scenes = workspace_.dataset().path / "scenes";
  folder_ = QString::fromStdString(scenes.string());
  begin(scene_lister(scenes), sceneNames());
}

void WatchWork::watchFiles(const PairOptions& options, const QStringList& known) {
  if (!workspace_.is_open()) return;
  stop();
  folder_ = QString::fromStdString(options.images.string());
  import_ = PairImportOptions{};
  import_->camera = workspace_.dataset().camera;
  std::set<std::string> names = sceneNames();
  for (const QString& name : known) names.insert(name.toStdString());
  begin(pair_lister(options), std::move(names));
}

void WatchWork::begin(FolderLister lister, std::set<std::string> known) {
  dataset_ = workspace_.dataset().path;
  watch_.emplace(std::move(lister), std::move(known));
  Q_EMIT changed();
  look();
}

void WatchWork::stop() {
  if (!watching()) return;
  timer_.stop();
  runner_.cancel();
  watch_.reset();
  import_.reset();
  pending_.clear();
  waiting_.clear();
  in_trouble_ = false;
  folder_.clear();
  Q_EMIT changed();
}

void WatchWork::look() {
  if (!watching()) return;
  runner_.start(
      [this, watch = *watch_, import = import_, target = workspace_.dataset().target,
       dataset = dataset_](const RunContext& context, const Runner::Post&) -> Runner::Deliver {
        Found found{watch, {}, {}, {}, {}};
        auto look = found.watch.look(context);
        if (context.stopped()) return {};
        if (!look) {
          found.error = look.error();
        } else if (!import) {
          for (const FilePair& pair : look->ready)
            found.folders.push_back(pair.image.parent_path());
        } else {
          PairImportOptions options = *import;
          options.board_check = make_board_check(target, context);
          const FolderWatch after = found.watch;
          found.watch = watch;
          for (const FilePair& pair : look->ready) {
            auto added = add_pairs({pair}, options, dataset, context);
            if (context.stopped()) return {};
            if (!added) {
              // A full disk: this one and those after it are tried again.
              found.error = added.error();
              break;
            }
            found.watch.know(pair.name);
            if (added->pairs.front().taken) {
              found.folders.push_back(dataset / "scenes" / pair.name);
            } else {
              found.refused.push_back(std::move(added->pairs.front()));
            }
          }
          if (!found.error) found.watch = after;
        }
        if (look) found.pending = std::move(look->pending);
        return [this, found = std::move(found)] { take(found); };
      });
}

void WatchWork::take(Found found) {
  if (!watching()) return;
  watch_ = std::move(found.watch);
  pending_ = std::move(found.pending);
  if (found.error && !in_trouble_) Q_EMIT failed(*found.error);
  in_trouble_ = found.error.has_value();
  if (found.error) pending_.push_back({"", found.error->sentence()});
  waiting_.insert(waiting_.end(), found.folders.begin(), found.folders.end());
  for (const ImportedPair& pair : found.refused)
    Q_EMIT refused(QString::fromStdString(pair.files.name), pair.reason);
  Q_EMIT looked();
  timer_.start();
  QTimer::singleShot(0, this, &WatchWork::handOver);
}

void WatchWork::handOver() {
  if (!watching() || waiting_.empty() || workspace_.busy()) return;
  QStringList folders;
  QStringList names;
  for (const std::filesystem::path& folder : std::exchange(waiting_, {})) {
    folders << QString::fromStdString(folder.string());
    names << QString::fromStdString(folder.filename().string());
  }
  if (Status s = workspace_.take_new_scenes(folders); !s) {
    Q_EMIT failed(s.error());
    return;
  }
  ran_last_ = true;
  Q_EMIT arrived(names);
}

}  // namespace lvcalib::widgets

#include "moc_watch_work.cpp"
