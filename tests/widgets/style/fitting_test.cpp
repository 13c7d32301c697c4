// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/fitting.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QHeaderView>
#include <QTableWidget>
#include <QTest>

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

}  // namespace
}  // namespace lvcalib::widgets::fitting_test
