// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <optional>

#include "dialogs/choices.h"
#include "runner/runner.h"
#include "target/target.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace lvcalib::widgets {

/// Draws the board for printing, exactly to scale: on one page of its own size, or on pages of a
/// paper that are glued together.
class PrintDialog : public QDialog {
  Q_OBJECT

 public:
  /// `present`: the board of what is open, if anything is. `choices` must outlive this.
  PrintDialog(const std::optional<Target>& present, Choices& choices, const QString& folder,
              QWidget* parent = nullptr);
  ~PrintDialog() override;
  [[nodiscard]] bool busy() const { return runner_.running(); }

 private:
  void build();
  void chooseBoard(int index);
  void start();
  void refresh();
  void retranslate();
  [[nodiscard]] QString layoutText() const;

  Choices& choices_;
  QString folder_;
  std::vector<Target> boards_;  // As in the box, before the item that asks for a file.
  QStringList board_names_;     // Of those that came from a file.
  std::optional<Error> error_;
  QString written_;
  int last_board_ = 0;
  bool has_present_ = false;

  QLabel* labels_[3];
  QComboBox* board_;
  QComboBox* paper_;
  QLineEdit* file_;
  QPushButton* place_;
  QLabel* text_;
  QPushButton* write_;
  QPushButton* close_;
  Runner runner_;  // Last: stopped before what it tells goes.
};

}  // namespace lvcalib::widgets
