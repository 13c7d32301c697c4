// SPDX-License-Identifier: BSD-3-Clause
#include "diagnostics/board_intensity.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>

#include "model/print_rows.h"

namespace lvcalib {
namespace {

// Intensity of a return as the model has it; nothing where the model's beam misses the board.
std::optional<double> predicted_intensity(PrintRows& rows, const RangeRow& row) {
  const IntensityReading reading{row.intensity, 1.0, row.seen};
  std::optional<PrintRow> p;
  if (row.beam.edge) {
    BoundaryRow edge;
    edge.beam = row.beam;
    edge.psi_rad = row.beam.edge->psi_rad;
    edge.transition_m = row.beam.edge->transition_m;
    edge.reading = reading;
    p = rows.edge(edge);
  } else {
    p = rows.intensity({row.beam, row.print, 0.0, 1.0, reading});
  }
  if (!p) return std::nullopt;
  return row.intensity - p->residual;
}

}  // namespace

BoardIntensity board_intensity(const FittedModel& model, int scene, double cell_m) {
  const MeasurementTable& table = model.table;
  BoardIntensity out;
  std::vector<const RangeRow*> rows;
  for (const RangeRow& row : table.range) {
    if (scene < 0 || row.beam.scene == scene) rows.push_back(&row);
  }
  if (rows.empty() || !table.has_intensity) return out;
  const BoardOutline outline = table.target.outline();
  const Eigen::Vector2d size = outline.size_m();
  // About four returns a cell, not finer than a millimetre.
  if (!(cell_m > 0.0)) {
    cell_m =
        std::max(1e-3, std::sqrt(4.0 * size.x() * size.y() / static_cast<double>(rows.size())));
  }
  out.columns = std::clamp(static_cast<int>(std::ceil(size.x() / cell_m)), 1, 2000);
  out.rows = std::clamp(static_cast<int>(std::ceil(size.y() / cell_m)), 1, 2000);
  const auto cells = static_cast<std::size_t>(out.columns) * static_cast<std::size_t>(out.rows);
  std::vector<double> measured(cells);
  std::vector<double> predicted(cells);
  std::vector<double> count(cells);
  std::deque<PrintRows> print;
  for (std::size_t k = 0; k < table.scenes.size(); ++k)
    print.emplace_back(table, model.state, k, model.effects);
  for (const RangeRow* row : rows) {
    const Eigen::Vector2d at = (row->beam.board_m - outline.lower_left_m).cwiseQuotient(size);
    const int x = std::clamp(static_cast<int>(at.x() * out.columns), 0, out.columns - 1);
    const int y = std::clamp(static_cast<int>(at.y() * out.rows), 0, out.rows - 1);
    const auto cell = static_cast<std::size_t>(y * out.columns + x);
    const auto p = predicted_intensity(print[static_cast<std::size_t>(row->beam.scene)], *row);
    if (!p) continue;
    measured[cell] += row->intensity;
    predicted[cell] += *p;
    count[cell] += 1.0;
  }
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t k = 0; k < cells; ++k) {
    const bool hit = count[k] > 0.0;
    out.measured.push_back(hit ? static_cast<float>(measured[k] / count[k]) : kNone);
    out.predicted.push_back(hit ? static_cast<float>(predicted[k] / count[k]) : kNone);
    out.difference.push_back(out.measured.back() - out.predicted.back());
  }
  return out;
}

}  // namespace lvcalib
