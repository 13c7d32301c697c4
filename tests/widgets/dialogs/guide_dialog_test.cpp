// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialogs/guide_dialog.h"

#include <QPointer>
#include <QTest>
#include <QTextBlock>
#include <QTextBrowser>

#include <gtest/gtest.h>

namespace lvcalib::widgets::guide_dialog_test {
namespace {

TEST(GuideDialog, LeadsFromTheBoardToTheResultAndCloses) {
  QPointer<GuideDialog> dialog = new GuideDialog(0, nullptr);
  dialog->show();
  const QString text = dialog->findChild<QTextBrowser*>()->toPlainText();
  for (const char* word : {"Print the board", "scenes/NAME/image.png", "F5", "Ctrl+E"})
    EXPECT_TRUE(text.contains(word)) << word;
  QTest::keyClick(dialog, Qt::Key_Escape);
  EXPECT_TRUE(QTest::qWaitFor([&] { return dialog.isNull(); }, 2000));
}

// Each page's chapter begins at the top of what is in view.
TEST(GuideDialog, OpensAtThePageInView) {
  const char* titles[] = {"From the board", "Scene", "Refinement", "Extrinsic"};
  for (int chapter = 0; chapter < 4; ++chapter) {
    GuideDialog dialog(chapter, nullptr);
    dialog.setAttribute(Qt::WA_DeleteOnClose, false);
    dialog.resize(600, 300);
    dialog.show();
    QTest::qWait(50);
    const auto* text = dialog.findChild<QTextBrowser*>();
    const QTextCursor top = text->cursorForPosition({20, 12});
    EXPECT_TRUE(top.block().text().startsWith(QLatin1String(titles[chapter])))
        << top.block().text().toStdString();
  }
}

}  // namespace
}  // namespace lvcalib::widgets::guide_dialog_test
