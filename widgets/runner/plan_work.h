// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QString>
#include <filesystem>
#include <memory>
#include <optional>

#include "design/planning.h"
#include "pipeline/calibration.h"
#include "runner/runner.h"

namespace lvcalib::widgets {

/// What a plan is made for.
struct PlanRequest {
  Target target;
  Camera camera;
  /// As a data sheet describes it; absent: the one that took the scenes of `result`.
  std::optional<LidarDescription> lidar;
  /// Of the scenes taken; its extrinsic is the rough pose. May be null if there is a LiDAR.
  std::shared_ptr<const CalibrationResult> result;
  /// A whole cloud of the scenes taken, which shows the LiDAR's field of view: without it, that is
  /// what the boards have covered. May be empty.
  std::filesystem::path cloud;
  /// The plan begins from what `result` knows of the extrinsic instead of from nothing, and
  /// proposes no pose of its scenes again.
  bool go_on = false;
  PlanOptions options;
};

/// Plans board poses in a worker thread.
class PlanWork : public QObject {
  Q_OBJECT

 public:
  explicit PlanWork(QObject* parent = nullptr);

  /// ready() or failed() follows unless it is cancelled, then ended(). A newer request takes the
  /// place of an older one.
  void request(const PlanRequest& request);
  void cancel() { runner_.cancel(); }
  [[nodiscard]] bool busy() const { return runner_.running(); }

 Q_SIGNALS:
  void ready(const std::shared_ptr<const lvcalib::ScenePlan>& plan);
  void failed(const lvcalib::Error& error);
  void progressed(double fraction, const QString& text);
  void cancelled();
  /// The work has ended, however.
  void ended();

 private:
  Runner runner_;
};

}  // namespace lvcalib::widgets
