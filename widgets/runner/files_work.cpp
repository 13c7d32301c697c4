// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/files_work.h"

#include <QBuffer>
#include <QImageReader>
#include <utility>

#include "base/file_io.h"
#include "pipeline/board_check.h"

namespace lvcalib::widgets {
namespace {

constexpr std::size_t kMostImage = 256U << 20U;

QImage thumbnail_of(const std::string& file) {
  QByteArray bytes = QByteArray::fromRawData(file.data(), static_cast<qsizetype>(file.size()));
  QBuffer buffer(&bytes);
  QImageReader reader(&buffer);
  const QSize size = reader.size();
  if (size.isValid())
    reader.setScaledSize(
        size.scaled(FilesWork::kThumbnailPx, FilesWork::kThumbnailPx, Qt::KeepAspectRatio));
  return reader.read();
}

}  // namespace

FilesWork::FilesWork(QObject* parent) : QObject(parent) {
  connect(&runner_, &Runner::progressed, this,
          [this](quint64, const QString&, double fraction, const QString& text) {
            Q_EMIT progressed(fraction, text);
          });
  connect(&runner_, &Runner::cancelled, this, &FilesWork::cancelled);
  connect(&runner_, &Runner::failed, this, [this](quint64, const QString& message) {
    Q_EMIT failed(Error::input(Message::verbatim(message.toStdString())));
  });
}

// A job that only makes room for the next one was not cancelled by anybody.
void FilesWork::start(Runner::Work work) {
  pictures_.cancel();
  runner_.abandon();
  runner_.start(std::move(work));
}

void FilesWork::find(const PairOptions& options) {
  start([this, options](const RunContext& context, const Runner::Post&) -> Runner::Deliver {
    auto files = find_pairs(options);
    if (context.stopped()) return {};
    if (!files) return [this, error = files.error()] { Q_EMIT failed(error); };
    return [this, out = std::move(*files)] { Q_EMIT found(out); };
  });
}

void FilesWork::show_pictures(const std::vector<FilePair>& pairs,
                              const std::optional<Target>& target,
                              const std::optional<Camera>& camera) {
  pictures_.start([this, pairs, target, camera](const RunContext& context,
                                                const Runner::Post& post) -> Runner::Deliver {
    for (std::size_t i = 0; i < pairs.size() && !context.stopped(); ++i) {
      const auto bytes = read_text_file(pairs[i].image, kMostImage);
      if (!bytes) continue;  // The import says why.
      const int index = static_cast<int>(i);
      const QImage image = thumbnail_of(*bytes);
      const bool checked = target && camera;
      const Message complaint =
          checked ? board_complaint(*bytes, *target, *camera, context) : Message();
      if (context.stopped()) break;
      post([this, index, image, checked, complaint] {
        Q_EMIT pictured(index, image, checked, complaint);
      });
    }
    return {};
  });
}

void FilesWork::import(const PairedFiles& files, const Target& target, PairImportOptions options,
                       const QString& dataset) {
  options.target_yaml = to_yaml(target);
  start([this, files, target, options, dataset](const RunContext& context,
                                                const Runner::Post&) -> Runner::Deliver {
    PairImportOptions checked = options;
    checked.board_check = make_board_check(target, context);
    const auto summary = import_pairs(files, checked, dataset.toStdString(), context);
    if (!summary) {
      if (summary.error().kind == ErrorKind::kCancelled) return {};
      return [this, error = summary.error()] { Q_EMIT failed(error); };
    }
    return [this, dataset, out = *summary] { Q_EMIT imported(out, dataset); };
  });
}

void FilesWork::cancel() {
  pictures_.cancel();
  runner_.cancel();
}

}  // namespace lvcalib::widgets

#include "moc_files_work.cpp"
