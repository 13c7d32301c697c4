// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialogs/error_dialog.h"

#include <QApplication>
#include <QClipboard>
#include <QLabel>
#include <QPushButton>
#include <QTest>

#include <gtest/gtest.h>

namespace lvcalib::widgets::error_dialog_test {
namespace {

TEST(ErrorDialog, NamesFileAndWayOutAndCopiesTheCommandLinesMessage) {
  const Error error =
      Error::input(Message("has no intensity <b>"), "/d/cloud.pcd", Message("record it with it"));
  auto* dialog = new ErrorDialog(error, nullptr);
  dialog->show();
  QString shown;
  for (const QLabel* label : dialog->findChildren<QLabel*>()) shown += label->text() + "\n";
  EXPECT_TRUE(shown.contains("Has no intensity <b>")) << shown.toStdString();
  EXPECT_TRUE(shown.contains("/d/cloud.pcd"));
  EXPECT_TRUE(shown.contains("record it with it"));
  for (QPushButton* button : dialog->findChildren<QPushButton*>()) {
    if (button->text().contains("Copy")) QTest::mouseClick(button, Qt::LeftButton);
  }
  EXPECT_EQ(QApplication::clipboard()->text().toStdString(), error.text());
  EXPECT_EQ(dialog->text().toStdString(), error.text());
  QTest::keyClick(dialog, Qt::Key_Escape);
}

}  // namespace
}  // namespace lvcalib::widgets::error_dialog_test
