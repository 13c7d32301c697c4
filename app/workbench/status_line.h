// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStatusBar>
#include <memory>
#include <optional>

#include "pipeline/calibration.h"
#include "style/marks.h"
#include "words/quality_text.h"

class QLabel;
class QProgressBar;

namespace lvcalib::widgets {

/// Stage, fraction and text of what runs; quality of what is there.
class StatusLine : public QStatusBar {
  Q_OBJECT

 public:
  explicit StatusLine(QWidget* parent = nullptr);
  void show_progress(const QString& stage, double fraction, const QString& text);
  /// Nothing runs; `message` stays as the text.
  void show_idle(const QString& message);
  void show_quality(const std::shared_ptr<const CalibrationResult>& result,
                    const Standing& standing);
  [[nodiscard]] QString text() const;

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void draw_mark();

  std::optional<Mark> shown_;
  QLabel* stage_;
  QProgressBar* bar_;
  QLabel* text_;
  QLabel* mark_;
  QLabel* quality_;
};

}  // namespace lvcalib::widgets
