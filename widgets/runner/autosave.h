// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QList>
#include <QObject>
#include <QString>
#include <QThreadPool>
#include <QTimer>
#include <functional>
#include <string>

#include "base/error.h"
#include "pipeline/project_file.h"

namespace lvcalib::widgets {

/// Decisions that were not saved when a program ended without saying so.
struct Recovery {
  QString file;          ///< The autosave.
  QString project_path;  ///< Where the project is; empty if it was never saved.
  Project project;
};

/// Keeps unsaved decisions on disk, one small file per running program in a folder of the
/// application's data. Written off the interface thread, atomically, soon after each change.
class Autosave : public QObject {
  Q_OBJECT

 public:
  /// How long changes are collected before they are written.
  static constexpr int kDelayMs = 500;

  explicit Autosave(QString folder, QObject* parent = nullptr);
  /// Removes the file: a program that ends in order leaves nothing to recover.
  ~Autosave() override;

  /// Has the project written soon. `project_path` is its own file, empty if there is none yet.
  void keep(const Project& project, const QString& project_path);
  /// Nothing is unsaved any more.
  void clear();
  [[nodiscard]] QString file() const { return file_; }

  /// What programs that no longer run have left in a folder; unreadable files are left out.
  static QList<Recovery> find(const QString& folder);
  static void discard(const Recovery& recovery);

 Q_SIGNALS:
  void written();
  void failed(const QString& message);

 private:
  void write();

  QString folder_;
  QString file_;
  std::string text_;
  QTimer timer_;
  QThreadPool pool_;  // One thread: writes stay in order.
};

}  // namespace lvcalib::widgets
