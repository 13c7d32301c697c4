// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/add_effect_dialog.h"

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPointer>
#include <QPushButton>
#include <QTabWidget>

#include <gtest/gtest.h>

#include "model_example.h"

namespace lvcalib::widgets {
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

}  // namespace
}  // namespace lvcalib::widgets
