// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QString>
#include <QStringList>
#include <QTimer>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "recording/folder_watch.h"
#include "recording/pair_import.h"
#include "runner/runner.h"

namespace lvcalib::widgets {

class Workspace;

/// Watches a folder for the dataset that is open: what another program writes there becomes a scene
/// of the workspace, which is solved at once. It looks once a second in a worker thread; a scene
/// waits until what runs has ended.
class WatchWork : public QObject {
  Q_OBJECT

 public:
  /// Between the end of a look and the next: two looks tell that a file stands still.
  static constexpr int kLook_ms = 1000;

  /// The workspace must outlive it.
  explicit WatchWork(Workspace& workspace, QObject* parent = nullptr);

  /// New scene folders in the open dataset.
  void watchScenes();
  /// New pairs of images and clouds elsewhere, which become scenes of the open dataset. `known`:
  /// names of pairs that are not to be taken, besides those of the dataset's scenes.
  void watchFiles(const PairOptions& options, const QStringList& known);
  /// What is being looked at is dropped; what is being added to the dataset stays in it.
  void stop();

  [[nodiscard]] bool watching() const { return watch_.has_value(); }
  /// Whether pairs of files are watched, rather than scene folders.
  [[nodiscard]] bool watchingFiles() const { return watching() && import_.has_value(); }
  [[nodiscard]] QString folder() const { return folder_; }
  [[nodiscard]] const std::vector<PendingPair>& pending() const { return pending_; }
  /// Whether the last run of the workspace was begun because a scene has come.
  [[nodiscard]] bool ranLast() const { return ran_last_; }

 Q_SIGNALS:
  /// Watching has begun or ended.
  void changed();
  /// After every look: pending() may be another.
  void looked();
  /// These scenes are being solved.
  void arrived(const QStringList& scenes);
  /// A pair was left for good.
  void refused(const QString& name, const lvcalib::Message& reason);
  /// The folder cannot be listed; told once until it can again.
  void failed(const lvcalib::Error& error);

 private:
  struct Found;
  void begin(FolderLister lister, std::set<std::string> known);
  void look();
  void take(Found found);
  void handOver();
  [[nodiscard]] std::set<std::string> sceneNames() const;

  Workspace& workspace_;
  std::optional<FolderWatch> watch_;
  std::optional<PairImportOptions> import_;  // Of files: how they become scenes.
  std::filesystem::path dataset_;
  QString folder_;
  std::vector<PendingPair> pending_;
  std::vector<std::filesystem::path> waiting_;  // Scene folders not handed over yet.
  bool in_trouble_ = false;
  bool ran_last_ = false;
  QTimer timer_;
  Runner runner_;  // Last: abandoned before what it uses goes.
};

}  // namespace lvcalib::widgets
