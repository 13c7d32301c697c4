// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStatusBar>
#include <memory>
#include <optional>

#include "pipeline/calibration.h"
#include "style/marks.h"

class QLabel;
class QProgressBar;

namespace lvcalib::widgets {

/// What a search has found to be missing in the model whose quality is shown.
enum class Missing {
  kNothing,  ///< Or nothing that matters.
  kSomething,
  kSought,     ///< The search is still going on.
  kNotSought,  ///< There was no search, or it came to no end.
};

/// Stage, fraction and text of what runs; quality of what is there.
class StatusLine : public QStatusBar {
  Q_OBJECT

 public:
  explicit StatusLine(QWidget* parent = nullptr);
  void show_progress(const QString& stage, double fraction, const QString& text);
  /// Nothing runs; `message` stays as the text.
  void show_idle(const QString& message);
  /// A result is called good, without more, only where nothing is missing in its model.
  void show_quality(const std::shared_ptr<const CalibrationResult>& result, bool up_to_date,
                    Missing missing);
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
