// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/add_effect_dialog.h"

#include <QApplication>
#include <QComboBox>
#include <QEvent>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPointer>
#include <QPushButton>
#include <QTabWidget>

#include <gtest/gtest.h>

#include "model_example.h"

namespace lvcalib::widgets::add_effect_dialog_test {
namespace {

class Dialog : public ::testing::Test {
 protected:
  Dialog() : dialog_(new AddEffectDialog(test::model_example().base)) {
    QObject::connect(dialog_, &AddEffectDialog::addWanted, dialog_,
                     [this](const QString& spec) { added_ = spec; });
  }
  ~Dialog() override { delete dialog_; }
  template <class T>
  T* part(const char* name) {
    return dialog_->findChild<T*>(QString::fromLatin1(name));
  }
  QPointer<AddEffectDialog> dialog_;
  QString added_;
};

TEST_F(Dialog, SearchesByAnyWord) {
  auto* list = part<QListWidget>("effects");
  const int all = list->count();
  EXPECT_GT(all, 20);
  part<QLineEdit>("effect_search")->setText("dark print");
  ASSERT_GE(list->count(), 1);
  EXPECT_LT(list->count(), all);
  EXPECT_EQ(list->item(0)->text(), "Range walk");
  part<QPushButton>("add_chosen")->click();
  EXPECT_EQ(added_, "range_walk");
  part<QLineEdit>("effect_search")->setText("no effect has these words");
  EXPECT_EQ(list->count(), 0);
  EXPECT_FALSE(part<QPushButton>("add_chosen")->isEnabled());
}

TEST_F(Dialog, AFormulaIsCheckedWhileItIsTyped) {
  dialog_->findChild<QTabWidget*>()->setCurrentIndex(1);
  auto* add = part<QPushButton>("add_chosen");
  EXPECT_FALSE(add->isEnabled());
  part<QLineEdit>("formula")->setText("a*darknes");
  EXPECT_FALSE(add->isEnabled() && part<QLabel>("add_problem")->text().isEmpty());
  part<QLineEdit>("formula")->setText("a*darkness");
  ASSERT_TRUE(add->isEnabled()) << part<QLabel>("add_problem")->text().toStdString();
  add->click();
  EXPECT_EQ(added_, "formula:range:a*darkness");
}

TEST_F(Dialog, ACurveIsSuggestedWhereStructureIs) {
  dialog_->suggestCurve(Channel::kRange, "azimuth");
  EXPECT_EQ(part<QComboBox>("curve_first")->currentData().toString(), "azimuth");
  part<QPushButton>("add_chosen")->click();
  EXPECT_EQ(added_, "curve:range:azimuth");
}

TEST_F(Dialog, ASurfaceIsSuggestedWhereItTakesTwoCovariates) {
  dialog_->suggestCurve(Channel::kRange, "board x", "board y");
  part<QPushButton>("add_chosen")->click();
  EXPECT_EQ(added_, "curve:range:board x,board y");
}

// A change of language fills every list anew; what was chosen stays.
TEST_F(Dialog, ANewLanguageKeepsTheChoice) {
  dialog_->suggestCurve(Channel::kRange, "azimuth", "elevation");
  part<QLineEdit>("formula")->setText("a*darkness");
  QEvent change(QEvent::LanguageChange);
  QApplication::sendEvent(dialog_, &change);
  EXPECT_FALSE(dialog_->windowTitle().isEmpty());
  EXPECT_EQ(part<QLineEdit>("formula")->text(), "a*darkness");
  part<QPushButton>("add_chosen")->click();
  EXPECT_EQ(added_, "curve:range:azimuth,elevation");
}

}  // namespace
}  // namespace lvcalib::widgets::add_effect_dialog_test
