// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QTimer>
#include <memory>

#include "pipeline/session.h"
#include "runner/runner.h"

namespace lvcalib::widgets {

class Workspace;

/// What other decisions about the solve would give, made in a worker thread from what the last run
/// left. A newer question takes the place of an older one; nothing of the workspace changes.
class PreviewWork : public QObject {
  Q_OBJECT

 public:
  /// How long a question must stand before it is worked on: a line is being dragged.
  static constexpr int kSettleMs = 120;

  /// The workspace must outlive it.
  explicit PreviewWork(Workspace& workspace, QObject* parent = nullptr);

  void request(const Decisions& decisions);
  void cancel();
  [[nodiscard]] bool busy() const { return settle_.isActive() || runner_.running(); }

 Q_SIGNALS:
  /// `present`: the result that it is to be compared with.
  void ready(const std::shared_ptr<const lvcalib::CalibrationResult>& present,
             const std::shared_ptr<const lvcalib::CalibrationResult>& preview);
  void failed(const lvcalib::Error& error);

 private:
  void start();

  Workspace& workspace_;
  Decisions wanted_;
  QTimer settle_;
  Runner runner_;  // Last: abandoned before what it uses goes.
};

}  // namespace lvcalib::widgets
