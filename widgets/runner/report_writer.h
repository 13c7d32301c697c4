// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QStringList>
#include <memory>

#include "pipeline/calibration.h"
#include "report/frame_names.h"
#include "runner/runner.h"

namespace lvcalib::widgets {

/// Writes the HTML report of a calibration in a worker thread, one at a time.
class ReportWriter : public QObject {
  Q_OBJECT

 public:
  explicit ReportWriter(QObject* parent = nullptr);
  /// Writes to `path` (`discovery`: what was found out about the model, may be null); written(),
  /// failed() or cancelled() follows. Takes the place of a report that is being written. A file at
  /// `path` is replaced only by a whole report.
  void write(std::shared_ptr<const CalibrationResult> result,
             std::shared_ptr<const Discovery> discovery, const QString& path,
             const FrameNames& frames = {});
  void cancel() { runner_.cancel(); }
  [[nodiscard]] bool busy() const { return runner_.running(); }

 Q_SIGNALS:
  void progressed(const QString& stage, double fraction, const QString& text);
  /// `warnings`: what the report had to do without.
  void written(const QString& path, const QStringList& warnings);
  void failed(const lvcalib::Error& error);
  void cancelled();

 private:
  Runner runner_;
};

}  // namespace lvcalib::widgets
