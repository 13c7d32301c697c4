// SPDX-License-Identifier: BSD-3-Clause
#include "model/noise_floor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "base/statistics.h"

namespace lvcalib {

double replicate_sigma(const std::vector<Eigen::Vector2d>& board_m,
                       const std::vector<double>& values, const std::vector<int>& strata,
                       double distance_m, int min_pairs) {
  // The last point of every cell and stratum pairs with the next one there.
  std::map<std::tuple<int, int, int>, std::size_t> last;
  std::vector<double> squares;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::tuple key{strata[i], static_cast<int>(std::floor(board_m[i].x() / distance_m)),
                         static_cast<int>(std::floor(board_m[i].y() / distance_m))};
    const auto [entry, fresh] = last.try_emplace(key, i);
    if (fresh) continue;
    const double d = values[i] - values[entry->second];
    squares.push_back(d * d);
    last.erase(entry);
  }
  constexpr double kMedianOfSquare = 0.4549;
  if (static_cast<int>(squares.size()) < min_pairs) return 0.0;
  return std::sqrt(median(std::move(squares)) / (2.0 * kMedianOfSquare));
}

double corner_noise(const MeasurementTable& table, const ModelState& state, double fallback_px) {
  constexpr std::size_t kFewest = 12;
  std::map<std::tuple<int, int, int>, Eigen::Vector2d> residual;  // scene, feature, corner
  for (const CornerRow& row : table.corner) {
    const auto p =
        table.camera.project(state.camera_from_board[static_cast<std::size_t>(row.scene)] *
                             Eigen::Vector3d(row.board_m.x(), row.board_m.y(), 0.0));
    if (p) residual[{row.scene, row.feature, row.corner}] = row.pixel - *p;
  }
  const int columns = table.target.corner_columns;
  std::vector<double> sums;
  for (const auto& [key, first] : residual) {
    const auto [scene, feature, corner] = key;
    if (corner != 0) continue;
    std::array<std::tuple<int, int, int>, 3> others;
    if (table.target.has_tags()) {
      others = {std::tuple{scene, feature, 1}, {scene, feature, 2}, {scene, feature, 3}};
    } else {
      if (feature % columns + 1 == columns) continue;
      others = {std::tuple{scene, feature + 1, 0},
                {scene, feature + columns + 1, 0},
                {scene, feature + columns, 0}};
    }
    Eigen::Vector2d sum = first;
    double sign = -1.0;
    bool all = true;
    for (const auto& other : others) {
      const auto at = residual.find(other);
      all = all && at != residual.end();
      if (!all) break;
      sum += sign * at->second;
      sign = -sign;
    }
    if (all) sums.insert(sums.end(), {sum.x(), sum.y()});
  }
  if (sums.size() < kFewest) return fallback_px;
  const double sigma = 0.5 * mad_sigma(std::move(sums));
  return sigma > 0.0 ? sigma : fallback_px;
}

}  // namespace lvcalib
