// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/fitting.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QHeaderView>
#include <QTableWidget>
#include <QTest>
#include <QTreeWidget>

#include <gtest/gtest.h>

namespace lvcalib::widgets::fitting_test {
namespace {

TEST(Fitting, AListIsAsWideAsItsLongestEntry) {
  QComboBox box;
  box.setFixedWidth(70);
  show_entries_in_full(box);
  const QString longest = QStringLiteral("distance from the edge of a circle 12.3 %");
  box.addItems({QStringLiteral("range"), longest});
  const int needed = QFontMetrics(box.view()->font()).horizontalAdvance(longest);
  EXPECT_TRUE(QTest::qWaitFor([&] { return box.view()->minimumWidth() > needed; }, 2000));
  box.setItemText(1, longest + longest);
  EXPECT_TRUE(QTest::qWaitFor([&] { return box.view()->minimumWidth() > 2 * needed; }, 2000));
}

TEST(Fitting, HeadingsTakeTheLinesThatTheyNeed) {
  QTableWidget table(1, 3);
  table.horizontalHeader()->setDefaultAlignment(Qt::AlignCenter |
                                                static_cast<Qt::Alignment>(Qt::TextWordWrap));
  table.horizontalHeader()->setMinimumSectionSize(20);
  keep_headings_whole(table);
  table.setHorizontalHeaderLabels({"a", "b", "from joint (mm)"});
  table.show();
  const QFontMetrics metrics(table.horizontalHeader()->font());
  const auto lines = [&] { return (table.horizontalHeader()->height() - 4) / metrics.height(); };
  const int word = metrics.horizontalAdvance("joint");
  table.setColumnWidth(2, word + 12);
  EXPECT_TRUE(QTest::qWaitFor([&] { return lines() == 3; }, 2000)) << lines();
  table.setColumnWidth(2, 10 * word);
  EXPECT_TRUE(QTest::qWaitFor([&] { return lines() == 1; }, 2000)) << lines();
}

TEST(Fitting, RowsOfATreeTakeTheLinesThatTheyNeed) {
  QTreeWidget tree;
  tree.setColumnCount(2);
  tree.setWordWrap(true);
  tree.header()->setStretchLastSection(false);
  auto* item = new QTreeWidgetItem(&tree, {QStringLiteral("an effect of long name")});
  new QTreeWidgetItem(item, {QStringLiteral("one")});
  tree.expandAll();
  tree.show();
  const int longest = tree.fontMetrics().horizontalAdvance(QStringLiteral("effect"));
  const int needed = width_of_longest_word(tree, 0);
  EXPECT_GT(needed, longest);
  EXPECT_LT(needed, longest + tree.indentation() + 20);
  item->setCheckState(0, Qt::Checked);
  EXPECT_GT(width_of_longest_word(tree, 0), needed + 10) << "the box takes room";
  tree.setColumnWidth(0, width_of_longest_word(tree, 0));
  wrap_words(tree, 0);
  EXPECT_GE(tree.visualItemRect(item).height(), 3 * tree.fontMetrics().height());
  tree.setColumnWidth(0, 400);
  wrap_words(tree, 0);
  EXPECT_LT(tree.visualItemRect(item).height(), 2 * tree.fontMetrics().height());
  // In Chinese a line may end between any two characters.
  item->setText(0, QString::fromUtf8("强度随距离和入射角的变化关系"));
  EXPECT_LT(width_of_longest_word(tree, 0), tree.fontMetrics().horizontalAdvance(item->text(0)));
}

}  // namespace
}  // namespace lvcalib::widgets::fitting_test
