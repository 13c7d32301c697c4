// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>

class QTextBrowser;

namespace lvcalib::widgets {

/// The short guide: from the printed board to a result, then a chapter for each page.
class GuideDialog : public QDialog {
  Q_OBJECT

 public:
  /// Opens at a chapter: 0 the beginning, then the pages as their tabs are counted, from 1.
  explicit GuideDialog(int chapter, QWidget* parent = nullptr);

 private:
  void retranslate();

  QTextBrowser* browser_;
  int chapter_;
};

}  // namespace lvcalib::widgets
