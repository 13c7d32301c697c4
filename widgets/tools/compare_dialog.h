// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <memory>
#include <optional>

#include "dialogs/choices.h"
#include "pipeline/calibration.h"
#include "report/result_comparison.h"

class QLabel;
class QPushButton;
class QTreeWidget;

namespace lvcalib::widgets {

/// The present extrinsic beside another: a result, or the truth of a simulation.
class CompareDialog : public QDialog {
  Q_OBJECT

 public:
  /// `choices` must outlive this; `folder`: where files are looked for first.
  CompareDialog(const std::shared_ptr<const CalibrationResult>& result, Choices& choices,
                const QString& folder, QWidget* parent = nullptr);
  void open(const QString& path);

 private:
  void retranslate();
  void showTable();
  [[nodiscard]] QString verdict() const;

  Choices& choices_;
  StatedExtrinsic present_;
  QString folder_;
  QString path_;
  std::optional<StatedExtrinsic> other_;
  std::optional<ExtrinsicDifference> difference_;
  std::optional<Error> error_;
  QLabel* file_;
  QPushButton* choose_;
  QLabel* verdict_;
  QTreeWidget* table_;
  QPushButton* close_;
};

}  // namespace lvcalib::widgets
