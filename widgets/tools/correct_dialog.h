// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <memory>
#include <optional>

#include "dialogs/choices.h"
#include "runner/correction_work.h"

class QCheckBox;
class QDoubleSpinBox;
class QLabel;
class QListWidget;
class QLineEdit;
class QProgressBar;
class QPushButton;

namespace lvcalib::widgets {

/// Takes the effects of the model in force out of a cloud or a folder of clouds.
class CorrectDialog : public QDialog {
  Q_OBJECT

 public:
  /// `choices` must outlive this; `folder`: where clouds are looked for first.
  CorrectDialog(std::shared_ptr<const CalibrationResult> result, Choices& choices,
                const QString& folder, QWidget* parent = nullptr);
  ~CorrectDialog() override;
  [[nodiscard]] bool busy() const { return work_.busy(); }

 private:
  void build();
  [[nodiscard]] CorrectionOptions options() const;
  void choose(const QString& path);
  void start();
  void refresh();
  void retranslate();
  [[nodiscard]] QString modelText() const;
  [[nodiscard]] QString summaryText() const;

  std::shared_ptr<const CalibrationResult> result_;
  Choices& choices_;
  QString folder_;
  std::optional<Error> error_;
  std::optional<CorrectedClouds> done_;
  bool cancelled_ = false;

  QLabel* model_;
  QLabel* labels_[3];
  QLineEdit* input_;
  QLineEdit* output_;
  QListWidget* effects_;
  QCheckBox* has_clock_;
  QDoubleSpinBox* clock_;
  QPushButton* cloud_;
  QPushButton* clouds_;
  QPushButton* place_;
  QLabel* summary_;
  QProgressBar* progress_;
  QPushButton* stop_;
  QPushButton* correct_;
  QPushButton* close_;
  CorrectionWork work_;  // Last: stopped before what it tells goes.
};

}  // namespace lvcalib::widgets
