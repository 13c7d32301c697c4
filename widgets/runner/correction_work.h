// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <string>
#include <vector>

#include "model/correction.h"
#include "pipeline/calibration.h"
#include "runner/runner.h"

namespace lvcalib::widgets {

/// What became of the clouds of one run.
struct CorrectedClouds {
  std::size_t clouds = 0;
  std::vector<Message> problems;  ///< Clouds that could not be corrected, and why.
  std::vector<Message> warnings;  ///< Clouds that may not be whole, and why.
  CorrectionSummary total;        ///< Of all clouds together.
};

/// Takes the effects of a calibration's model out of a cloud, or of all clouds in a folder, in a
/// worker thread.
class CorrectionWork : public QObject {
  Q_OBJECT

 public:
  explicit CorrectionWork(QObject* parent = nullptr);
  /// corrected(), failed() or cancelled() follows. A folder's clouds keep their places and names,
  /// as binary PCD. Each cloud is written whole or not at all.
  void correct(std::shared_ptr<const CalibrationResult> result, const QString& input,
               const QString& output, const CorrectionOptions& options = {});
  void cancel() { runner_.cancel(); }
  [[nodiscard]] bool busy() const { return runner_.running(); }

 Q_SIGNALS:
  void progressed(double fraction, const QString& cloud);
  void corrected(const lvcalib::widgets::CorrectedClouds& clouds);
  void failed(const lvcalib::Error& error);
  void cancelled();

 private:
  Runner runner_;
};

}  // namespace lvcalib::widgets
