// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <memory>
#include <vector>

#include "runner/step_comparison.h"

class QComboBox;
class QLabel;
class QTreeWidget;

namespace lvcalib::widgets {

/// Two steps of the model's history side by side: how far the pose moved, how well either is known,
/// and the residuals of every scene.
class CompareStepsDialog : public QDialog {
  Q_OBJECT

 public:
  /// `source`: the calibration that the steps were made from. Steps that are null are left out.
  CompareStepsDialog(std::shared_ptr<const CalibrationResult> source,
                     std::vector<ModelStepPtr> steps, std::size_t current,
                     QWidget* parent = nullptr);

 private:
  void retranslate();
  void ask();
  void showTables();

  std::shared_ptr<const CalibrationResult> source_;
  std::vector<ModelStepPtr> steps_;
  std::shared_ptr<const CalibrationResult> results_[2];
  StepComparison work_;
  QComboBox* choices_[2];
  QLabel* labels_[2];
  QLabel* verdict_;
  QTreeWidget* pose_;
  QTreeWidget* scenes_;
};

}  // namespace lvcalib::widgets
