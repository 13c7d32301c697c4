// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/preview_work.h"

#include <utility>

#include "runner/workspace.h"

namespace lvcalib::widgets {

PreviewWork::PreviewWork(Workspace& workspace, QObject* parent)
    : QObject(parent), workspace_(workspace) {
  settle_.setSingleShot(true);
  connect(&settle_, &QTimer::timeout, this, &PreviewWork::start);
  // Another result answers other questions.
  connect(&workspace_, &Workspace::result_changed, this, &PreviewWork::cancel);
  connect(&runner_, &Runner::failed, this,
          [this](quint64, const QString& message) { Q_EMIT failed(Runner::unexpected(message)); });
}

void PreviewWork::request(const Decisions& decisions) {
  wanted_ = decisions;
  runner_.cancel();
  settle_.start(kSettleMs);
}

void PreviewWork::cancel() {
  settle_.stop();
  runner_.cancel();
}

void PreviewWork::start() {
  const auto present = workspace_.result();
  if (!present) return;
  runner_.start([this, present, dataset = workspace_.dataset(), decisions = wanted_,
                 state = workspace_.state()](const RunContext& context,
                                             const Runner::Post&) -> Runner::Deliver {
    auto result = preview_session(dataset, decisions, state, context);
    if (!result) {
      return [this, error = result.error()] {
        if (error.kind != ErrorKind::kCancelled) Q_EMIT failed(error);
      };
    }
    return
        [this, present, preview = std::make_shared<const CalibrationResult>(std::move(*result))] {
          Q_EMIT ready(present, preview);
        };
  });
}

}  // namespace lvcalib::widgets

#include "moc_preview_work.cpp"
