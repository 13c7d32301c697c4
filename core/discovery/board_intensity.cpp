// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/board_intensity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/effect_rows.h"

namespace lvcalib {
namespace {

// Received power of every return as the model has it.
class Predictor {
 public:
  explicit Predictor(const ModelStep& step)
      : table_(step.table()),
        in_use_(step.in_use()),
        columns_(columns_in_use(in_use_, table_)),
        rows_(table_, columns_.list()) {}

  double operator()(const RangeRow& row) {
    // The print's mixture under the beam, then what the effects in use make of it.
    double log_level =
        std::log(table_.level_of(Print::kWhite)) - row.beam.darkness * table_.log_contrast;
    IntensityRow intensity{row.beam, row.print, log_level, 1.0};
    rows_.intensity(intensity, [&](const EffectColumns& c, std::span<const double> by) {
      const auto at = static_cast<std::size_t>(&c - columns_.list().data());
      for (std::size_t k = 0; k < by.size(); ++k)
        log_level += by[k] * in_use_[at].values(static_cast<Eigen::Index>(k));
    });
    return std::exp(log_level);
  }

 private:
  const MeasurementTable& table_;
  std::vector<EffectInUse> in_use_;
  EffectColumnsList columns_;
  EffectRows rows_;
};

}  // namespace

BoardIntensity board_intensity(const ModelStep& step, int scene, double cell_m) {
  const MeasurementTable& table = step.table();
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
  out.x_low_m = outline.lower_left_m.x();
  out.x_high_m = outline.upper_right_m.x();
  out.y_low_m = outline.lower_left_m.y();
  out.y_high_m = outline.upper_right_m.y();
  const auto cells = static_cast<std::size_t>(out.columns) * static_cast<std::size_t>(out.rows);
  std::vector<double> measured(cells);
  std::vector<double> predicted(cells);
  std::vector<double> count(cells);
  Predictor predict(step);
  for (const RangeRow* row : rows) {
    const Eigen::Vector2d at = (row->beam.board_m - outline.lower_left_m).cwiseQuotient(size);
    const int x = std::clamp(static_cast<int>(at.x() * out.columns), 0, out.columns - 1);
    const int y = std::clamp(static_cast<int>(at.y() * out.rows), 0, out.rows - 1);
    const auto cell = static_cast<std::size_t>(y * out.columns + x);
    measured[cell] += row->intensity;
    predicted[cell] += predict(*row);
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
