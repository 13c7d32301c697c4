// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <memory>
#include <vector>

#include "pipeline/calibration.h"
#include "runner/runner.h"
#include "selection/model_session.h"

namespace lvcalib::widgets {

/// The calibrations at two steps of a model's history, made in a worker thread.
class StepComparison : public QObject {
  Q_OBJECT

 public:
  explicit StepComparison(QObject* parent = nullptr);

  /// `source`: the calibration with the base model, which `steps` begin at. Steps up to `first` and
  /// `second` must be made. A newer question takes the place of an older one.
  void request(const std::shared_ptr<const CalibrationResult>& source,
               const std::vector<ModelStepPtr>& steps, std::size_t first, std::size_t second);
  [[nodiscard]] bool busy() const { return runner_.running(); }

 Q_SIGNALS:
  void ready(const std::shared_ptr<const lvcalib::CalibrationResult>& first,
             const std::shared_ptr<const lvcalib::CalibrationResult>& second);

 private:
  Runner runner_;
};

}  // namespace lvcalib::widgets
