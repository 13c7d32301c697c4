// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialogs/about_dialog.h"

#include "report/result_file.h"
#include "style/texts.h"

namespace lvcalib::widgets {

AboutDialog::AboutDialog(QWidget* parent) : QMessageBox(parent) {
  setAttribute(Qt::WA_DeleteOnClose);
  setObjectName(QStringLiteral("about_dialog"));
  setIcon(QMessageBox::Information);
  setStandardButtons(QMessageBox::Close);
  setModal(false);
  follow_language(this, [this] {
    setWindowTitle(tr("About"));
    setText(tr("LV-Calib Workbench %1\n\nLiDAR–camera calibration with a printed "
               "board.\nGPL-3.0-or-later "
               "(core library: BSD-3-Clause)")
                .arg(QString::fromStdString(version())));
  });
}

}  // namespace lvcalib::widgets

#include "moc_about_dialog.cpp"
