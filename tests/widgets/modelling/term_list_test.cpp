// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/term_list.h"

#include <QHeaderView>
#include <QPushButton>
#include <QTreeWidget>

#include <gtest/gtest.h>

#include "model_example.h"

namespace lvcalib::widgets::term_list_test {
namespace {

class Terms : public ::testing::Test {
 protected:
  Terms() : tree_(list_.findChild<QTreeWidget*>("terms")) {
    list_.setStep(test::model_example().mended, test::model_example().base);
    QObject::connect(&list_, &TermList::holdWanted, &list_,
                     [this](int, const std::optional<Eigen::VectorXd>& values) {
                       ++holds_;
                       held_ = values;
                     });
  }
  [[nodiscard]] QTreeWidgetItem* walk() const { return tree_->topLevelItem(1); }
  TermList list_;
  QTreeWidget* tree_;
  int holds_ = 0;
  std::optional<Eigen::VectorXd> held_;
};

TEST_F(Terms, ListsEffectsWithValuesAndDeviations) {
  ASSERT_EQ(tree_->topLevelItemCount(), 2);
  EXPECT_EQ(walk()->text(0), "Range walk");
  EXPECT_TRUE(walk()->text(1).contains(QString::fromUtf8("±")));
  EXPECT_TRUE(walk()->text(1).endsWith("mm"));
  EXPECT_EQ(walk()->checkState(0), Qt::Checked);
}

TEST_F(Terms, AllColumnsAreSeenHoweverNarrowItsPlaceIs) {
  list_.resize(120, 300);
  list_.show();
  QTest::qWait(20);
  EXPECT_GE(tree_->viewport()->width(), tree_->header()->length());
  EXPECT_LE(list_.width(), 330);
}

// Two effects with long names: what they take is missing to the figures and the list of scenes.
TEST_F(Terms, LongNamesTakeMoreLinesAndNotMoreWidth) {
  const auto two = add_effect(test::model_example().mended, "range_incidence", 0.0, {});
  ASSERT_TRUE(two.ok());
  list_.setStep(*two, test::model_example().base);
  list_.resize(120, 300);
  list_.show();
  QTest::qWait(50);
  QTreeWidgetItem* item = tree_->topLevelItem(2);
  ASSERT_EQ(item->text(0), "Range error with incidence");
  const QFontMetrics metrics = tree_->fontMetrics();
  const QRect room = tree_->visualItemRect(item);
  EXPECT_GE(room.height(), 2 * metrics.height());
  const int whole = metrics.horizontalAdvance(item->text(0) + item->text(1));
  EXPECT_LT(tree_->width(), whole + tree_->columnWidth(2));
  EXPECT_GE(tree_->viewport()->width(), tree_->header()->length());
  EXPECT_GE(tree_->columnWidth(1), metrics.horizontalAdvance(item->text(1)));
  EXPECT_GT(tree_->columnWidth(0), metrics.horizontalAdvance(QStringLiteral("incidence")) + 20);
  // With room for all of it the name stands in one line again.
  list_.resize(600, 300);
  QTest::qWait(50);
  EXPECT_LT(tree_->visualItemRect(item).height(), 2 * metrics.height());
}

TEST_F(Terms, CheckBoxesAskForOnAndHeld) {
  QSignalSpy on(&list_, &TermList::onWanted);
  walk()->setCheckState(0, Qt::Unchecked);
  ASSERT_EQ(on.count(), 1);
  EXPECT_FALSE(on.last().at(1).toBool());
  QTest::qWait(10);
  EXPECT_EQ(walk()->checkState(0), Qt::Checked) << "until it is done";
  walk()->setCheckState(2, Qt::Checked);
  ASSERT_EQ(holds_, 1);
  ASSERT_TRUE(held_);
  EXPECT_EQ((*held_)(0), test::model_example().mended->terms[0].use.values(0));
}

TEST_F(Terms, ATypedValueIsHeld) {
  walk()->setText(1, "7.5");
  ASSERT_EQ(holds_, 1);
  EXPECT_DOUBLE_EQ((*held_)(0), 0.0075);
  QTest::qWait(10);
  walk()->setText(1, "seven");
  EXPECT_EQ(holds_, 1) << "what is no number changes nothing";
  QTest::qWait(10);
  EXPECT_TRUE(walk()->text(1).contains(QString::fromUtf8("±")));
}

TEST_F(Terms, RemovesTheChosenOneAndNothingWhileBusy) {
  QSignalSpy removed(&list_, &TermList::removeWanted);
  auto* button = list_.findChild<QPushButton*>("remove_effect");
  EXPECT_FALSE(button->isEnabled());
  tree_->setCurrentItem(walk());
  EXPECT_TRUE(button->isEnabled());
  button->click();
  ASSERT_EQ(removed.count(), 1);
  EXPECT_EQ(removed.last().at(0).toInt(), 0);
  list_.setChangeable(false);
  EXPECT_FALSE(button->isEnabled());
  EXPECT_FALSE(list_.findChild<QPushButton*>("add_effect")->isEnabled());
}

}  // namespace
}  // namespace lvcalib::widgets::term_list_test
