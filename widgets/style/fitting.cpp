// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/fitting.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QHeaderView>
#include <QStyle>
#include <QTableWidget>
#include <QTextBoundaryFinder>
#include <QTimer>
#include <QTreeWidget>
#include <QTreeWidgetItemIterator>
#include <algorithm>

namespace lvcalib::widgets {
namespace {

constexpr int kHeadingMargin = 8;

// What stands in a cell beside its words: indentation of its level, box to tick, margins.
int beside_words(const QTreeWidgetItem& item, const QTreeWidget& tree, int column) {
  // One level also where no branch is drawn: the tree may break lines a little earlier.
  int levels = 1;
  for (const QTreeWidgetItem* up = item.parent(); up != nullptr; up = up->parent()) ++levels;
  const QStyle* style = tree.style();
  const int margin = style->pixelMetric(QStyle::PM_FocusFrameHMargin, nullptr, &tree) + 1;
  int taken = levels * tree.indentation() + 2 * margin;
  if (item.data(column, Qt::CheckStateRole).isValid())
    taken += style->pixelMetric(QStyle::PM_IndicatorWidth, nullptr, &tree) + 2 * margin;
  return taken;
}

QFontMetrics metrics_of(const QTreeWidgetItem& item, const QTreeWidget& tree, int column) {
  return QFontMetrics(item.font(column).resolve(tree.font()));
}

}  // namespace

void show_entries_in_full(QComboBox& box) {
  auto* later = new QTimer(&box);  // Entries come and change in numbers.
  later->setSingleShot(true);
  later->setInterval(0);
  QObject::connect(later, &QTimer::timeout, &box, [&box] {
    const QFontMetrics metrics(box.view()->font());
    int widest = 0;
    for (int k = 0; k < box.count(); ++k)
      widest = std::max(widest, metrics.horizontalAdvance(box.itemText(k)));
    const int bar = box.style()->pixelMetric(QStyle::PM_ScrollBarExtent, nullptr, &box);
    box.view()->setMinimumWidth(widest + bar + 2 * kHeadingMargin);
  });
  const auto start = [later] { later->start(); };
  QObject::connect(box.model(), &QAbstractItemModel::rowsInserted, later, start);
  QObject::connect(box.model(), &QAbstractItemModel::rowsRemoved, later, start);
  QObject::connect(box.model(), &QAbstractItemModel::dataChanged, later, start);
  start();
}

void keep_headings_whole(QTableWidget& table) {
  QHeaderView* header = table.horizontalHeader();
  auto* later = new QTimer(&table);  // Not within the layout that has moved a section.
  later->setSingleShot(true);
  later->setInterval(0);
  QObject::connect(later, &QTimer::timeout, &table, [&table, header] {
    const QFontMetrics metrics(header->font());
    int height = metrics.height();
    for (int c = 0; c < table.columnCount(); ++c) {
      const QTableWidgetItem* title = table.horizontalHeaderItem(c);
      if (title == nullptr || table.isColumnHidden(c)) continue;
      const QRect room(0, 0, std::max(1, header->sectionSize(c) - kHeadingMargin), 10'000);
      const auto flags = static_cast<int>(Qt::AlignCenter) | static_cast<int>(Qt::TextWordWrap);
      height = std::max(height, metrics.boundingRect(room, flags, title->text()).height());
    }
    header->setFixedHeight(height + kHeadingMargin);
  });
  const auto start = [later] { later->start(); };
  QObject::connect(header, &QHeaderView::sectionResized, later, start);
  QObject::connect(table.model(), &QAbstractItemModel::headerDataChanged, later, start);
  start();
}

void wrap_words(QTreeWidget& tree, int column) {
  constexpr int kLeading = 4;
  constexpr int kNarrowest = 40;
  const int width = tree.header()->sectionSize(column);
  for (QTreeWidgetItemIterator at(&tree); *at != nullptr; ++at) {
    QTreeWidgetItem& item = **at;
    const int room = std::max(kNarrowest, width - beside_words(item, tree, column));
    const QRect lines =
        metrics_of(item, tree, column)
            .boundingRect(QRect(0, 0, room, 10'000), Qt::TextWordWrap, item.text(column));
    const QSize size(room, lines.height() + kLeading);
    if (item.sizeHint(column) != size) item.setSizeHint(column, size);
  }
}

int width_of_longest_word(const QTreeWidget& tree, int column) {
  int widest = 0;
  for (QTreeWidgetItemIterator at(const_cast<QTreeWidget*>(&tree)); *at != nullptr; ++at) {
    const QTreeWidgetItem& item = **at;
    const QFontMetrics metrics = metrics_of(item, tree, column);
    const QString text = item.text(column);
    // Where a line may end, which in Chinese is between any two characters.
    QTextBoundaryFinder ends(QTextBoundaryFinder::Line, text);
    for (qsizetype from = 0, to = 0; (to = ends.toNextBoundary()) > from; from = to) {
      const QString word = text.mid(from, to - from).trimmed();
      widest = std::max(widest, metrics.horizontalAdvance(word) + beside_words(item, tree, column));
    }
  }
  return widest;
}

}  // namespace lvcalib::widgets
