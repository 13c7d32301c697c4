// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QSettings>
#include <QString>
#include <QStringList>

#include "style/theme.h"

namespace lvcalib::widgets {

/// What the application remembers between starts, and where it keeps data of its own.
class AppSettings {
 public:
  static constexpr int kMaxRecent = 10;

  /// In the user's places; needs the application's name.
  AppSettings();
  /// All in one folder, for tests and portable use.
  explicit AppSettings(const QString& folder);

  /// Where autosaves and the demo go.
  [[nodiscard]] QString data_folder() const { return data_folder_; }

  /// Datasets and projects, latest first.
  [[nodiscard]] QStringList recent() const;
  void add_recent(const QString& path);

  [[nodiscard]] Theme theme() const;
  void set_theme(Theme theme);
  /// "en", "zh_CN"; empty: the system's language.
  [[nodiscard]] QString language() const;
  void set_language(const QString& language);

  [[nodiscard]] QByteArray geometry() const;
  [[nodiscard]] QByteArray window_state() const;
  void set_window(const QByteArray& geometry, const QByteArray& state);

  /// What the user called the frames last, for projects that have no names yet; "lidar" and
  /// "camera" at first.
  [[nodiscard]] QString lidar_frame() const;
  [[nodiscard]] QString camera_frame() const;
  void set_frame_names(const QString& lidar, const QString& camera);

  /// Folder in which the last file was chosen.
  [[nodiscard]] QString last_folder() const;
  void set_last_folder(const QString& folder);

 private:
  mutable QSettings settings_;
  QString data_folder_;
};

}  // namespace lvcalib::widgets
