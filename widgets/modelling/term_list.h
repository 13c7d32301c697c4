// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <optional>

#include "selection/model_session.h"

class QLabel;
class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace lvcalib::widgets {

/// The effects in the model with their values: on or off, held or fitted, removed, added.
class TermList : public QWidget {
  Q_OBJECT

 public:
  explicit TermList(QWidget* parent = nullptr);
  ~TermList() override;
  /// Null: no model yet.
  void setStep(const ModelStepPtr& step, const ModelStepPtr& base);
  /// Whether the model may be changed now.
  void setChangeable(bool changeable);

 Q_SIGNALS:
  void onWanted(int term, bool on);
  /// Values in SI; none: fitted.
  void holdWanted(int term, const std::optional<Eigen::VectorXd>& values);
  void removeWanted(int term);
  void addWanted();
  /// Its pattern is worth a look.
  void chosen(int term);

 private:
  void retranslate();
  void fill();
  void fitWidth();
  void fitRows();
  void addTerm(int k);
  void take(QTreeWidgetItem* item, int column);
  void updateButtons();
  [[nodiscard]] int current() const;

  ModelStepPtr step_;
  ModelStepPtr base_;
  bool changeable_ = true;
  QLabel* title_;
  QTreeWidget* tree_;
  QLabel* pose_;
  QPushButton* add_;
  QPushButton* remove_;
};

}  // namespace lvcalib::widgets
