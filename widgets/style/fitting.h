// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QComboBox;
class QTableWidget;
class QTreeWidget;

namespace lvcalib::widgets {

/// The list that drops down is as wide as its longest entry, however narrow the box is.
void show_entries_in_full(QComboBox& box);

/// The headings of a table take as many lines as they need in the columns' present widths, and
/// follow these.
void keep_headings_whole(QTableWidget& table);

/// The rows of a tree take as many lines as their words in one column need in its present width.
/// To be called again when rows or the width change: a tree's rows do not grow by themselves.
void wrap_words(QTreeWidget& tree, int column);

/// The width that a tree's column needs for its longest word: with less, wrapping does not help.
[[nodiscard]] int width_of_longest_word(const QTreeWidget& tree, int column);

}  // namespace lvcalib::widgets
