// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

class QComboBox;
class QTableWidget;

namespace lvcalib::widgets {

/// The list that drops down is as wide as its longest entry, however narrow the box is.
void show_entries_in_full(QComboBox& box);

/// The headings of a table take as many lines as they need in the columns' present widths, and
/// follow these.
void keep_headings_whole(QTableWidget& table);

}  // namespace lvcalib::widgets
