// SPDX-License-Identifier: GPL-3.0-or-later
#include "start/app_settings.h"

#include <QDir>
#include <QStandardPaths>

namespace lvcalib::widgets {

AppSettings::AppSettings()
    : data_folder_(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation)) {}

AppSettings::AppSettings(const QString& folder)
    : settings_(QDir(folder).filePath(QStringLiteral("settings.ini")), QSettings::IniFormat),
      data_folder_(QDir(folder).filePath(QStringLiteral("data"))) {}

QStringList AppSettings::recent() const {
  return settings_.value(QStringLiteral("recent")).toStringList();
}

void AppSettings::add_recent(const QString& path) {
  QStringList list = recent();
  list.removeAll(path);
  list.prepend(path);
  settings_.setValue(QStringLiteral("recent"), list.mid(0, kMaxRecent));
}

Theme AppSettings::theme() const {
  return theme_named(settings_.value(QStringLiteral("theme")).toString());
}

void AppSettings::set_theme(Theme theme) {
  settings_.setValue(QStringLiteral("theme"), name_of(theme));
}

QString AppSettings::language() const {
  return settings_.value(QStringLiteral("language")).toString();
}

void AppSettings::set_language(const QString& language) {
  settings_.setValue(QStringLiteral("language"), language);
}

QByteArray AppSettings::geometry() const {
  return settings_.value(QStringLiteral("window/geometry")).toByteArray();
}

QByteArray AppSettings::window_state() const {
  return settings_.value(QStringLiteral("window/state")).toByteArray();
}

void AppSettings::set_window(const QByteArray& geometry, const QByteArray& state) {
  settings_.setValue(QStringLiteral("window/geometry"), geometry);
  settings_.setValue(QStringLiteral("window/state"), state);
}

QString AppSettings::lidar_frame() const {
  return settings_.value(QStringLiteral("frames/lidar"), QStringLiteral("lidar")).toString();
}

QString AppSettings::camera_frame() const {
  return settings_.value(QStringLiteral("frames/camera"), QStringLiteral("camera")).toString();
}

void AppSettings::set_frame_names(const QString& lidar, const QString& camera) {
  settings_.setValue(QStringLiteral("frames/lidar"), lidar);
  settings_.setValue(QStringLiteral("frames/camera"), camera);
}

QString AppSettings::last_folder() const {
  return settings_.value(QStringLiteral("last_folder"), QDir::homePath()).toString();
}

void AppSettings::set_last_folder(const QString& folder) {
  settings_.setValue(QStringLiteral("last_folder"), folder);
}

}  // namespace lvcalib::widgets
