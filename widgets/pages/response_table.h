// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <optional>

#include "response/boundary_response.h"

class QTableWidget;
class QWidget;

namespace lvcalib::widgets {

/// A read-only table: a name, N, means and standard deviations of pitch (°), yaw (°) and range
/// (mm), each ± its own standard deviation, δ and σ of the transition (mm).
QTableWidget* new_response_table(QWidget* parent);

/// Its headings and tool tips in the present language.
void title_response_table(QTableWidget& table, const QString& name_title);

/// Leaves out the transition's columns, for a table whose rows have none.
void hide_transition(QTableWidget& table);

/// Adds a row; without statistics it says the reason instead of numbers.
void add_response_row(QTableWidget& table, const QString& name,
                      const std::optional<ResponseStatistics>& statistics,
                      const std::optional<TransitionFit>& transition, const QString& reason);

}  // namespace lvcalib::widgets
