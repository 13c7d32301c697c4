// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/autosave.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <cerrno>
#include <filesystem>
#include <utility>

#include <signal.h>
#include <unistd.h>

#include "base/file_io.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

constexpr const char* kPathLine = "# project: ";
constexpr std::size_t kMaxBytes = 4U << 20U;

std::filesystem::path to_path(const QString& text) {
  return {text.toStdString()};
}

bool is_running(qint64 pid) {
  return pid > 0 && (::kill(static_cast<pid_t>(pid), 0) == 0 || errno == EPERM);
}

}  // namespace

Autosave::Autosave(QString folder, QObject* parent)
    : QObject(parent),
      folder_(std::move(folder)),
      file_(QDir(folder_).filePath(QStringLiteral("autosave-%1.lvcalib").arg(::getpid()))) {
  pool_.setMaxThreadCount(1);
  timer_.setSingleShot(true);
  timer_.setInterval(kDelayMs);
  connect(&timer_, &QTimer::timeout, this, &Autosave::write);
}

Autosave::~Autosave() {
  clear();
}

void Autosave::keep(const Project& project, const QString& project_path) {
  text_ = kPathLine + project_path.toStdString() + "\n" +
          project_as_text(project, to_path(QDir(folder_).absolutePath()));
  if (!timer_.isActive()) timer_.start();  // Not put off by further changes.
}

void Autosave::clear() {
  timer_.stop();
  pool_.waitForDone();
  QFile::remove(file_);
}

void Autosave::write() {
  pool_.start([this, path = to_path(file_), folder = to_path(folder_), text = text_] {
    Status status = create_folder(folder);
    if (status) status = write_file_atomically(path, text);
    if (status) {
      Q_EMIT written();
    } else {
      Q_EMIT failed(core_text(status.error()));
    }
  });
}

QList<Recovery> Autosave::find(const QString& folder) {
  QList<Recovery> found;
  const QDir dir(folder);
  const auto files =
      dir.entryInfoList({QStringLiteral("autosave-*.lvcalib")}, QDir::Files, QDir::Time);
  for (const QFileInfo& info : files) {
    if (is_running(info.completeBaseName().section(QLatin1Char('-'), 1).toLongLong())) continue;
    const auto text = read_text_file(to_path(info.absoluteFilePath()), kMaxBytes);
    if (!text || !text->starts_with(kPathLine)) continue;
    auto project = project_from_text(*text, to_path(info.absoluteFilePath()));
    if (!project) continue;
    const std::string first = text->substr(0, text->find('\n'));
    found.push_back({info.absoluteFilePath(),
                     QString::fromStdString(first.substr(std::string(kPathLine).size())),
                     std::move(project->project)});
  }
  return found;
}

void Autosave::discard(const Recovery& recovery) {
  QFile::remove(recovery.file);
}

}  // namespace lvcalib::widgets

#include "moc_autosave.cpp"
