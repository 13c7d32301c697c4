// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QMessageBox>

namespace lvcalib::widgets {

/// Version and licence. Deletes itself when closed.
class AboutDialog : public QMessageBox {
  Q_OBJECT

 public:
  explicit AboutDialog(QWidget* parent = nullptr);
};

}  // namespace lvcalib::widgets
