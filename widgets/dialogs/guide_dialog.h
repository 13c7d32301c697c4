// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>

class QTextBrowser;

namespace lvcalib::widgets {

/// The short guide: from the printed board to a result, then a chapter for each page.
class GuideDialog : public QDialog {
  Q_OBJECT

 public:
  /// Opens at the chapter of a page, as their tabs are counted; −1: at the beginning.
  explicit GuideDialog(int page, QWidget* parent = nullptr);
  /// Comes to the front at the chapter of another page.
  void show_page(int page);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void retranslate();
  void showChapter();

  QTextBrowser* browser_;
  int page_;
};

}  // namespace lvcalib::widgets
