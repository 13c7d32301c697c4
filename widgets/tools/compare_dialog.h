// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <QImage>
#include <QLabel>
#include <memory>
#include <optional>
#include <vector>

#include "dialogs/choices.h"
#include "runner/comparison_work.h"
#include "runner/runner.h"
#include "views/image_overlay.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QProgressBar;
class QPushButton;
class QTreeWidget;
class QWidget;

namespace lvcalib::widgets {

class ImageView;

/// Two results side by side: steps of what is open, result files, truths, other projects. How far
/// the pose differs with what either states of its errors, the residuals of every scene, and what
/// both project into the picture of a scene.
class CompareDialog : public QDialog {
  Q_OBJECT

 public:
  /// `choices` must outlive this; `folder`: where files are looked for first.
  CompareDialog(ComparisonBasis basis, Choices& choices, const QString& folder,
                QWidget* parent = nullptr);
  /// Adds another result to those that can be chosen, and compares with it.
  void add(ComparedResult::Kind kind, const QString& path);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void createPicture(QWidget* parent);
  void connectParts();
  void retranslate();
  [[nodiscard]] QString nameOf(const ComparedResult& what) const;
  [[nodiscard]] std::optional<ComparedResult> chosen(int side) const;
  void ask();
  void take(const std::shared_ptr<const Comparison>& comparison);
  void showState();
  void showPose();
  void showScenes();
  void showLegend();
  void chooseScene();
  void showFactor();
  [[nodiscard]] QString verdict() const;

  ComparisonBasis basis_;
  Choices& choices_;
  QString folder_;
  std::vector<ComparedResult> results_;  // As listed in both boxes.
  std::shared_ptr<const Comparison> comparison_;
  std::optional<Error> error_;
  QString scene_;  // Whose picture is shown.
  QLabel* labels_[2];
  QComboBox* boxes_[2];
  QPushButton* file_;
  QPushButton* project_;
  QProgressBar* progress_;
  QPushButton* cancel_;
  QLabel* verdict_;
  QTreeWidget* pose_;
  QTreeWidget* scenes_;
  QWidget* picture_ = nullptr;
  ImageView* image_ = nullptr;
  QLabel* legend_ = nullptr;
  QLabel* factor_label_ = nullptr;
  QDoubleSpinBox* factor_ = nullptr;
  QCheckBox* points_ = nullptr;
  QPushButton* close_;
  Runner loader_;
  ComparisonWork work_;
};

}  // namespace lvcalib::widgets
