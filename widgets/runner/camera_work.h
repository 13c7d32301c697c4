// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QString>
#include <QStringList>
#include <filesystem>
#include <memory>
#include <vector>

#include "pipeline/camera_calibration.h"
#include "pipeline/dataset.h"
#include "runner/runner.h"

namespace lvcalib::widgets {

/// Calibrates a camera from images alone, and copies images into a dataset, in a worker thread.
class CameraWork : public QObject {
  Q_OBJECT

 public:
  explicit CameraWork(QObject* parent = nullptr);

  /// calibrated() or failed() follows, and ended(). A newer request takes the place of an older
  /// one.
  void calibrate(std::vector<std::filesystem::path> images, const Target& target,
                 const CameraCalibrationOptions& options);
  /// Copies images into the dataset's intrinsics/: added() or failed() follows, and ended().
  void add(const Dataset& dataset, const QStringList& images);
  void cancel() { runner_.cancel(); }
  [[nodiscard]] bool busy() const { return runner_.running(); }

 Q_SIGNALS:
  void calibrated(const std::shared_ptr<const lvcalib::CameraCalibration>& calibration);
  /// How many were chosen.
  void added(int images);
  void failed(const lvcalib::Error& error);
  void progressed(double fraction, const QString& text);
  /// The work has ended, however.
  void ended();

 private:
  Runner runner_;
};

}  // namespace lvcalib::widgets
