// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialogs/guide_dialog.h"

#include <QPointer>
#include <QTest>
#include <QTextBrowser>

#include <gtest/gtest.h>

namespace lvcalib::widgets::guide_dialog_test {
namespace {

TEST(GuideDialog, LeadsFromTheBoardToTheResultAndCloses) {
  QPointer<GuideDialog> dialog = new GuideDialog(nullptr);
  dialog->show();
  const QString text = dialog->findChild<QTextBrowser*>()->toPlainText();
  for (const char* word : {"lvcalib target", "scenes/NAME/image.png", "F5", "Ctrl+E"})
    EXPECT_TRUE(text.contains(word)) << word;
  QTest::keyClick(dialog, Qt::Key_Escape);
  EXPECT_TRUE(QTest::qWaitFor([&] { return dialog.isNull(); }, 2000));
}

}  // namespace
}  // namespace lvcalib::widgets::guide_dialog_test
