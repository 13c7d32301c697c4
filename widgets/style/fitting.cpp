// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/fitting.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QHeaderView>
#include <QStyle>
#include <QTableWidget>
#include <QTimer>
#include <algorithm>

namespace lvcalib::widgets {
namespace {

constexpr int kHeadingMargin = 8;

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

}  // namespace lvcalib::widgets
