// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>

#include "base/error.h"

class QAction;
class QDialogButtonBox;

namespace lvcalib::widgets {

/// Says what went wrong, in which file, and what can be done; does not block.
class ErrorDialog : public QDialog {
  Q_OBJECT

 public:
  ErrorDialog(const Error& error, QWidget* parent);
  /// The same message as the command line gives.
  [[nodiscard]] QString text() const { return text_; }
  /// A button for what helps: it closes the dialog and triggers the action. It has the action's
  /// name and words.
  void offer(QAction& action);

 private:
  QString text_;
  QDialogButtonBox* buttons_;
};

}  // namespace lvcalib::widgets
