// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <memory>

#include "pipeline/calibration.h"

class QLabel;
class QPushButton;

namespace lvcalib::widgets {

class ThresholdPlot;

/// The gate beyond which the solve leaves out tags and circles, as a line over what they miss the
/// board's pose by. Moving it asks for a preview: what would be refused, and where the extrinsic
/// would go.
class ThresholdPane : public QWidget {
  Q_OBJECT

 public:
  explicit ThresholdPane(QWidget* parent = nullptr);

  /// Null: nothing is known yet. The line goes back to the result's gate.
  void setResult(std::shared_ptr<const CalibrationResult> result);
  /// A preview is being made.
  void setBusy();
  /// What another gate gives (`preview`), beside what stands now.
  void setPreview(const CalibrationResult& present, const CalibrationResult& preview);
  void setError(const Error& error);

  /// How far a preview moves the extrinsic, and how well it would be known: a sentence.
  static QString moveText(const CalibrationResult& present, const CalibrationResult& preview);

 Q_SIGNALS:
  /// The line stands elsewhere: what would that give?
  void previewWanted(double gate);
  void previewDropped();
  /// This gate is to be used.
  void gateWanted(double gate);
  void failed(const QString& message);

 private:
  void retranslate();
  void moveLines(double gate);
  void showDistances(const CalibrationResult* result);
  void back();
  [[nodiscard]] double presentGate() const;

  std::shared_ptr<const CalibrationResult> result_;
  QLabel* intro_;
  ThresholdPlot* tags_;
  ThresholdPlot* circles_;
  QLabel* preview_;
  QPushButton* use_;
  QPushButton* back_;
};

}  // namespace lvcalib::widgets
