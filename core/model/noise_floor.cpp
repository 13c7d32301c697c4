// SPDX-License-Identifier: BSD-3-Clause
#include "model/noise_floor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "base/statistics.h"

namespace lvcalib {

double replicate_sigma(const std::vector<Eigen::Vector2d>& board_m,
                       const std::vector<double>& values, const std::vector<int>& strata,
                       double distance_m, int min_pairs) {
  // The last point of every cell and stratum pairs with the next one there.
  std::unordered_map<std::uint64_t, std::size_t> last;
  last.reserve(values.size());
  std::vector<double> squares;
  // Twenty-two bits a coordinate: four million cells are more than any board has.
  const auto bits = [](double cell) {
    constexpr int kMiddle = 1 << 21;
    return static_cast<std::uint64_t>(static_cast<int>(std::floor(cell)) + kMiddle) & 0x3fffffU;
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint64_t key = (static_cast<std::uint64_t>(strata[i] & 0xfffff) << 44U) |
                              (bits(board_m[i].x() / distance_m) << 22U) |
                              bits(board_m[i].y() / distance_m);
    const auto [entry, fresh] = last.try_emplace(key, i);
    if (fresh) continue;
    const double d = values[i] - values[entry->second];
    squares.push_back(d * d);
    last.erase(entry);
  }
  if (static_cast<int>(squares.size()) < min_pairs) return 0.0;
  // The mean of the squares, each cut at three standard deviations: a median would be nothing where
  // numbers are coarse. E[min(z², 9)] = 0.9904.
  constexpr double kCut = 9.0;
  constexpr double kCutMean = 0.9904;
  constexpr double kMedianOfSquare = 0.4549;
  std::vector<double> sorted = squares;
  double variance = median(std::move(sorted)) / kMedianOfSquare;
  if (!(variance > 0.0))
    variance =
        std::accumulate(squares.begin(), squares.end(), 0.0) / static_cast<double>(squares.size());
  for (int round = 0; round < 5; ++round) {
    double sum = 0.0;
    for (const double d : squares) sum += std::min(d, kCut * variance);
    variance = sum / (kCutMean * static_cast<double>(squares.size()));
  }
  return std::sqrt(0.5 * variance);
}

double Replicates::sigma() const {
  // σ is known to 1/√(2n): three per cent, so that what a channel misses by is not lost in its
  // floor's own error, and nine at worst.
  constexpr int kEnough = 550;
  constexpr int kFewest = 60;
  constexpr double kNearest = 0.003;
  // Farther neighbours only where there are no others: print and light change over centimetres.
  constexpr double kNear = 0.03;
  constexpr double kFarthest = 0.05;
  double sigma = 0.0;
  for (double distance = kNearest; distance < kFarthest; distance *= 2.0) {
    if (distance > kNear && sigma > 0.0) break;
    const double sure = replicate_sigma(at_, values_, strata_, distance, kEnough);
    if (sure > 0.0) return sure;
    sigma = replicate_sigma(at_, values_, strata_, distance, kFewest);
  }
  return sigma;
}

double corner_noise(const MeasurementTable& table, const ModelState& state, double fallback_px) {
  constexpr std::size_t kFewest = 12;  // These tell a standard deviation to a third.
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
