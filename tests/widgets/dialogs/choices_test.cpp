// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialogs/choices.h"

#include <QApplication>
#include <QMessageBox>
#include <QPushButton>
#include <QTest>
#include <QTimer>
#include <functional>

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

// Escape and Enter leave a failed result where it is.
TEST(Choices, AFailedResultIsExportedOnlyByTheButtonThatSaysSo) {
  Choices choices;
  QString text;
  const auto with_box = [&](const std::function<void(QMessageBox&)>& answer) {
    QTimer::singleShot(50, qApp, [&text, answer] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      ASSERT_NE(box, nullptr);
      text = box->text();
      answer(*box);
    });
    return choices.hand_on_failed(nullptr);
  };
  EXPECT_FALSE(with_box([](QMessageBox& box) { QTest::keyClick(&box, Qt::Key_Escape); }));
  EXPECT_TRUE(text.contains("This result has failed"));
  EXPECT_FALSE(with_box([](QMessageBox& box) { box.defaultButton()->click(); }));
  EXPECT_TRUE(with_box(
      [](QMessageBox& box) { box.findChild<QPushButton*>("export_all_the_same")->click(); }));
}

}  // namespace
}  // namespace lvcalib::widgets::choices_test
