// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>

namespace lvcalib::widgets {

/// The way from the printed board to a result, and what the pages show.
class GuideDialog : public QDialog {
  Q_OBJECT

 public:
  explicit GuideDialog(QWidget* parent);
};

}  // namespace lvcalib::widgets
