// SPDX-License-Identifier: GPL-3.0-or-later
// The window's side of a folder that is watched.
#include <QDir>
#include <utility>

#include "docks/log_dock.h"
#include "docks/scenes_dock.h"
#include "importing/files_dialog.h"
#include "tools/watch_window.h"
#include "words/core_text.h"
#include "workbench/main_actions.h"
#include "workbench/main_window.h"
#include "workbench/page_stack.h"

namespace lvcalib::widgets {

void MainWindow::connect_watch() {
  connect(actions_->watch_dataset, &QAction::triggered, this, [this](bool wanted) {
    wanted ? watch_->watchScenes() : watch_->stop();
    if (watch_->watching()) show_watch_window();
  });
  connect(actions_->watch_files, &QAction::triggered, this, &MainWindow::watch_files);
  connect(actions_->what_next, &QAction::triggered, this, &MainWindow::show_watch_window);
  connect(watch_.get(), &WatchWork::changed, this, [this] {
    actions_->watch_dataset->setChecked(watch_->watching() && !watch_->watchingFiles());
    actions_->watch_files->setChecked(watch_->watchingFiles());
    log_->append(watch_->watching()
                     ? tr("Watching %1.").arg(QDir::toNativeSeparators(watch_->folder()))
                     : tr("Watching has ended."));
    update_actions();
  });
  connect(watch_.get(), &WatchWork::refused, this,
          [this](const QString& name, const Message& reason) {
            log_->append(tr("%1: left: %2").arg(name, core_text(reason)));
          });
  connect(watch_.get(), &WatchWork::failed, this,
          [this](const Error& error) { log_->append(core_text(error)); });
  connect(workspace_.get(), &Workspace::scenes_appeared, this, &MainWindow::take_new_scenes);
  // Another dataset ends the watch by itself.
  connect(workspace_.get(), &Workspace::opened, this, [this] {
    if (!watch_next_) return;
    const PairOptions options = *watch_next_;
    watch_next_.reset();
    watch_->watchFiles(options, watch_known_);
    show_watch_window();
  });
}

// Into the dataset that is open; without one, into one that is made of what is there.
void MainWindow::watch_files(bool wanted) {
  if (!wanted) return watch_->stop();
  actions_->watch_files->setChecked(false);  // Until it is so.
  const QString folder = choices_.files_to_import(this, settings_.last_folder());
  if (folder.isEmpty()) return;
  if (!workspace_->is_open()) {
    import_files(folder);
    watch_imported_ = true;
    return;
  }
  PairOptions options;
  options.images = folder.toStdString();
  watch_->watchFiles(options, {});
  show_watch_window();
}

void MainWindow::show_watch_window() {
  if (!watch_window_) watch_window_ = new WatchWindow(*workspace_, *watch_, this);
  watch_window_->show();
  watch_window_->raise();
  watch_window_->activateWindow();
}

// As when a dataset is opened, but the page and the scene that are looked at stay.
void MainWindow::take_new_scenes() {
  const Dataset& dataset = workspace_->dataset();
  const QString shown = std::exchange(scene_, QString());
  model_.set_scenes(dataset, workspace_->missing_scenes());
  loader_.load_thumbnails(dataset.scenes);
  pages_->start(dataset);
  if (!dataset.scenes.empty()) scenes_->select(shown.isEmpty() ? scene_name(0) : shown);
  update_actions();
}

}  // namespace lvcalib::widgets
