// SPDX-License-Identifier: GPL-3.0-or-later
// The window's side of a new dataset from a recording.
#include <QDir>
#include <QFileInfo>
#include <utility>

#include "docks/log_dock.h"
#include "importing/files_dialog.h"
#include "importing/import_dialog.h"
#include "recording/file_pairs.h"
#include "recording/recording.h"
#include "start/welcome_page.h"
#include "words/core_text.h"
#include "workbench/main_actions.h"
#include "workbench/main_window.h"
#include "workbench/page_stack.h"

namespace lvcalib::widgets {
namespace {

// A recording, and no dataset or project that lies beside one.
bool is_to_be_imported(const QString& path) {
  const QFileInfo info(path);
  if (info.suffix() == QLatin1String("lvcalib")) return false;
  if (info.fileName() == QLatin1String("metadata.yaml")) return true;
  if (info.isDir() && QFileInfo(path + QStringLiteral("/scenes")).isDir()) return false;
  return looks_like_recording(path.toStdString());
}

}  // namespace

void MainWindow::connect_import() {
  const auto choose = [this] {
    const QString path = choices_.recording_to_open(this, settings_.last_folder());
    if (!path.isEmpty()) import_recording(path);
  };
  connect(actions_->import_recording, &QAction::triggered, this, choose);
  connect(&pages_->welcome(), &WelcomePage::import_wanted, this, choose);
  const auto choose_files = [this] {
    const QString path = choices_.files_to_import(this, settings_.last_folder());
    if (!path.isEmpty()) import_files(path);
  };
  connect(actions_->import_files, &QAction::triggered, this, choose_files);
  connect(&pages_->welcome(), &WelcomePage::import_files_wanted, this, choose_files);
}

void MainWindow::open(const QString& path) {
  if (looks_like_file_pairs(path.toStdString())) {
    import_files(path);
    return;
  }
  if (is_to_be_imported(path)) {
    import_recording(path);
    return;
  }
  if (!may_drop_decisions()) return;
  folder_wanted_.clear();
  // What is not there any more was a folder, unless its name says otherwise.
  const QFileInfo info(path);
  const bool project = info.suffix() == QLatin1String("lvcalib");
  if (info.isDir() || (!info.exists() && !project)) {
    folder_wanted_ = QDir::cleanPath(QDir::current().absoluteFilePath(path));
    workspace_->open_dataset(path);
  } else {
    workspace_->open_project(path);
  }
}

void MainWindow::import_recording(const QString& path) {
  if (!import_) {
    import_ = new ImportDialog(choices_, settings_.recent(), this);
    connect(import_, &ImportDialog::imported, this, &MainWindow::take_imported);
  }
  settings_.set_last_folder(QFileInfo(path).absolutePath());
  import_->openRecording(path);
  import_->show();
  import_->raise();
  import_->activateWindow();
}

void MainWindow::take_imported(const QString& dataset, const ImportSummary& summary) {
  log_->append(tr("Imported into %1: %2 of %3 still stretches are scenes.")
                   .arg(dataset)
                   .arg(summary.scene_count())
                   .arg(summary.stretches.size()));
  for (const ImportedStretch& s : summary.stretches) {
    const QString time =
        tr("%1 s to %2 s")
            .arg(QString::number(s.first_s, 'f', 1), QString::number(s.last_s, 'f', 1));
    log_->append(s.taken ? tr("%1: scene %2").arg(time, QString::fromStdString(s.scene))
                         : tr("%1: left: %2").arg(time, core_text(s.reason)));
  }
  for (const Message& warning : summary.warnings) log_->append(core_text(warning));
  calibrate_new(dataset);
}

void MainWindow::import_files(const QString& folder) {
  if (!files_) {
    files_ = new FilesDialog(choices_, settings_.recent(), this);
    connect(files_, &FilesDialog::imported, this,
            [this](const QString& dataset, const PairImportSummary& summary) {
              log_->append(tr("Imported into %1: %2 of %3 pairs are scenes.")
                               .arg(dataset)
                               .arg(summary.scene_count())
                               .arg(summary.pairs.size()));
              for (const ImportedPair& pair : summary.pairs) {
                const QString name = QString::fromStdString(pair.files.name);
                if (!pair.taken) log_->append(tr("%1: left: %2").arg(name, core_text(pair.reason)));
              }
              for (const Message& warning : summary.warnings) log_->append(core_text(warning));
              const bool watched = std::exchange(watch_imported_, false);
              if (!calibrate_new(dataset) || !watched) return;
              watch_next_ = files_->pairOptions();
              watch_known_ = files_->foundNames();
            });
  }
  watch_imported_ = false;
  settings_.set_last_folder(QFileInfo(folder).absolutePath());
  files_->openFolder(folder);
  files_->show();
  files_->raise();
  files_->activateWindow();
}

bool MainWindow::calibrate_new(const QString& dataset) {
  if (!may_drop_decisions()) return false;
  run_when_opened_ = true;
  workspace_->open_dataset(dataset);
  return true;
}

}  // namespace lvcalib::widgets
