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
  QPointer<GuideDialog> dialog = new GuideDialog(-1, nullptr);
  dialog->show();
  const QString text = dialog->findChild<QTextBrowser*>()->toPlainText();
  for (const char* word : {"Print the board", "scenes/NAME/image.png", "F5", "Ctrl+E"})
    EXPECT_TRUE(text.contains(word)) << word;
  QTest::keyClick(dialog, Qt::Key_Escape);
  EXPECT_TRUE(QTest::qWaitFor([&] { return dialog.isNull(); }, 2000));
}

// Each page's chapter begins at the top of what is in view.
TEST(GuideDialog, OpensAtThePageInView) {
  const char* titles[] = {"From the board", "Scene", "Refinement", "Extrinsic",
                          "Boundary",       "Model", "Camera"};
  for (int page = -1; page < 6; ++page) {
    GuideDialog dialog(page, nullptr);
    dialog.setAttribute(Qt::WA_DeleteOnClose, false);
    dialog.resize(600, 300);
    dialog.show();
    QTest::qWait(50);
    const auto* text = dialog.findChild<QTextBrowser*>();
    const QTextCursor top = text->cursorForPosition({20, 12});
    EXPECT_TRUE(top.block().text().startsWith(QLatin1String(titles[page + 1])))
        << top.block().text().toStdString();
  }
}

// What is hardest to guess stands first.
TEST(GuideDialog, TheModelPageComesFirst) {
  GuideDialog dialog(-1, nullptr);
  dialog.setAttribute(Qt::WA_DeleteOnClose, false);
  const QString text = dialog.findChild<QTextBrowser*>()->toPlainText();
  const auto at = [&](const char* title) { return text.indexOf(QString("\n%1\n").arg(title)); };
  EXPECT_GT(at("Model"), 0);
  EXPECT_LT(at("Model"), at("Scene"));
  EXPECT_LT(at("Scene"), at("Refinement"));
}

}  // namespace
}  // namespace lvcalib::widgets::guide_dialog_test
