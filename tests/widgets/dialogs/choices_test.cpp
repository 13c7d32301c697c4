// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialogs/choices.h"

#include <QApplication>
#include <QMessageBox>
#include <QPushButton>
#include <QTest>
#include <QTimer>

#include <gtest/gtest.h>

namespace lvcalib::widgets::choices_test {
namespace {

// Presses a button of the message box that is about to open.
void answer_with(QMessageBox::StandardButton button) {
  QTimer::singleShot(50, qApp, [button] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    ASSERT_NE(box, nullptr);
    QTest::mouseClick(box->button(button), Qt::LeftButton);
  });
}

TEST(Choices, UnsavedDecisionsHaveThreeAnswers) {
  Choices choices;
  answer_with(QMessageBox::Save);
  EXPECT_EQ(choices.unsaved(nullptr, "x"), UnsavedAnswer::kSave);
  answer_with(QMessageBox::Discard);
  EXPECT_EQ(choices.unsaved(nullptr, "x"), UnsavedAnswer::kDiscard);
  answer_with(QMessageBox::Cancel);
  EXPECT_EQ(choices.unsaved(nullptr, "x"), UnsavedAnswer::kCancel);
}

TEST(Choices, RecoveryAndMovedDatasetsCanBeDeclined) {
  Choices choices;
  answer_with(QMessageBox::Yes);
  EXPECT_TRUE(choices.recover(nullptr, "/d"));
  answer_with(QMessageBox::No);
  EXPECT_FALSE(choices.recover(nullptr, "/d"));
  answer_with(QMessageBox::Cancel);
  EXPECT_EQ(choices.moved_dataset(nullptr, "/d"), "");
}

}  // namespace
}  // namespace lvcalib::widgets::choices_test
