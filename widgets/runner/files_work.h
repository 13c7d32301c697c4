// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QObject>
#include <QString>
#include <optional>

#include "recording/pair_import.h"
#include "runner/runner.h"
#include "target/target.h"

namespace lvcalib::widgets {

/// Finds pairs of images and clouds in folders and makes a dataset of them, in a worker thread; and
/// shows the images in another.
class FilesWork : public QObject {
  Q_OBJECT

 public:
  static constexpr int kThumbnailPx = 128;

  explicit FilesWork(QObject* parent = nullptr);

  /// found() follows; takes the place of what runs.
  void find(const PairOptions& options);
  /// pictured() follows for each pair, in the background. Whether the board is seen is told where
  /// the camera is known.
  void show_pictures(const std::vector<FilePair>& pairs, const std::optional<Target>& target,
                     const std::optional<Camera>& camera);
  /// imported() follows.
  void import(const PairedFiles& files, const Target& target, PairImportOptions options,
              const QString& dataset);
  void cancel();
  [[nodiscard]] bool busy() const { return runner_.running(); }

 Q_SIGNALS:
  void progressed(double fraction, const QString& text);
  void found(const lvcalib::PairedFiles& files);
  /// `complaint`: why the board is not seen; empty if it is. `checked`: whether it was looked for.
  void pictured(int pair, const QImage& thumbnail, bool checked, const lvcalib::Message& complaint);
  void imported(const lvcalib::PairImportSummary& summary, const QString& dataset);
  void failed(const lvcalib::Error& error);
  void cancelled();

 private:
  void start(Runner::Work work);

  Runner pictures_;
  Runner runner_;
};

}  // namespace lvcalib::widgets
