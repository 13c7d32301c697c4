// SPDX-License-Identifier: BSD-3-Clause
#include "diagnostics/binned_residuals.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/statistics.h"

namespace lvcalib {
namespace {

constexpr std::size_t kFewest = 8;  // rows of a group
constexpr double kFalseAlarm = 0.05;
constexpr int kFewestScenes = 3;  // for a scatter between scenes

// Two-sided t quantile at a false alarm of 5 % over all groups.
double threshold(double freedom, std::size_t groups) {
  const double tail = 0.5 * kFalseAlarm / static_cast<double>(std::max<std::size_t>(1, groups));
  return student_gate(std::max(1.0, freedom), tail);
}

double square(double x) {
  return x * x;
}

struct Range {
  double low = 0.0;
  double high = 0.0;
};

Range range_of(std::span<const float> values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {static_cast<double>(*low), static_cast<double>(*high)};
}

}  // namespace

MeanResidual mean_residual(const ResidualSample& sample, std::span<const std::size_t> rows,
                           std::size_t groups) {
  MeanResidual out;
  out.n = rows.size();
  if (rows.empty()) return out;
  const auto weight = [&](std::size_t k) {
    return 1.0 / square(static_cast<double>(sample.sigma[k]));
  };
  double weights = 0.0;
  double sum = 0.0;
  for (const std::size_t k : rows) {
    weights += weight(k);
    sum += weight(k) * static_cast<double>(sample.value[k]);
  }
  out.mean = sum / weights;
  double scatter = 0.0;
  std::map<int, double> by_scene;
  for (const std::size_t k : rows) {
    const double d = static_cast<double>(sample.value[k]) - out.mean;
    scatter += weight(k) * d * d;
    by_scene[sample.scene[k]] += weight(k) * d;
  }
  out.scenes = static_cast<int>(by_scene.size());
  const auto n = static_cast<double>(rows.size());
  const double within = n > 1.0 ? std::sqrt(scatter / (n - 1.0) / weights) : HUGE_VAL;
  double between = 0.0;
  double freedom = n - 1.0;
  if (out.scenes >= kFewestScenes) {
    for (const auto& [scene, d] : by_scene) between += d * d;
    between = std::sqrt(between * out.scenes / (out.scenes - 1.0)) / weights;
    if (between > within) freedom = out.scenes - 1.0;
  }
  out.sigma = std::max({1.0 / std::sqrt(weights), within, between});
  out.significant = std::abs(out.mean) > threshold(freedom, groups) * out.sigma;
  return out;
}

std::vector<ResidualBin> bin_residuals(std::span<const float> x, bool labels,
                                       const ResidualSample& sample, int bins) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (std::isfinite(x[k])) order.push_back(k);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return x[a] < x[b]; });
  // Rows with the same value stay together, so that ties do not smear over bins.
  std::vector<std::span<const std::size_t>> groups;
  const double share = labels ? 0.0
                              : std::max(static_cast<double>(kFewest),
                                         static_cast<double>(order.size()) / std::max(1, bins));
  std::size_t first = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool last = k + 1 == order.size();
    if (!last && x[order[k + 1]] == x[order[k]]) continue;
    if (!last && static_cast<double>(k + 1 - first) < share) continue;
    if (k + 1 - first >= kFewest) groups.push_back(std::span(order).subspan(first, k + 1 - first));
    first = k + 1;
  }
  std::vector<ResidualBin> out;
  for (const auto& rows : groups) {
    ResidualBin bin;
    for (const std::size_t k : rows) bin.center += static_cast<double>(x[k]);
    bin.center /= static_cast<double>(rows.size());
    bin.residual = mean_residual(sample, rows, groups.size());
    out.push_back(bin);
  }
  return out;
}

ResidualMap map_residuals(std::span<const float> x, std::span<const float> y,
                          std::span<const int> component, const ResidualSample& sample, int cells) {
  ResidualMap map;
  if (x.empty()) return map;
  const Range rx = range_of(x);
  const Range ry = range_of(y);
  const double wide = std::max(rx.high - rx.low, 1e-9);
  const double tall = std::max(ry.high - ry.low, 1e-9);
  // Three times the fewest rows per cell on average.
  const double most = static_cast<double>(x.size()) / (3.0 * kFewest);
  const double along =
      std::min(static_cast<double>(std::max(1, cells)),
               std::max(1.0, std::sqrt(most * std::max(wide / tall, tall / wide))));
  const double size = std::max(wide, tall) / along;
  map.columns = std::max(1, static_cast<int>(std::lround(wide / size)));
  map.rows = std::max(1, static_cast<int>(std::lround(tall / size)));
  map.x_low = rx.low;
  map.x_high = rx.low + wide;
  map.y_low = ry.low;
  map.y_high = ry.low + tall;
  const auto count = static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows);
  std::vector<std::vector<std::size_t>> members[2];
  for (auto& part : members) part.resize(count);
  const auto place = [](double value, double low, double extent, int number) {
    return std::clamp(static_cast<int>((value - low) / extent * number), 0, number - 1);
  };
  for (std::size_t k = 0; k < x.size(); ++k) {
    const int column = place(static_cast<double>(x[k]), rx.low, wide, map.columns);
    const int row = place(static_cast<double>(y[k]), ry.low, tall, map.rows);
    const int part = component.empty() ? 0 : component[k];
    members[part][static_cast<std::size_t>(row * map.columns + column)].push_back(k);
  }
  const auto filled = static_cast<std::size_t>(
      std::count_if(members[0].begin(), members[0].end(),
                    [](const auto& rows) { return rows.size() >= kFewest; }));
  const std::size_t groups = component.empty() ? filled : 2 * filled;
  for (std::size_t c = 0; c < count; ++c) {
    if (members[0][c].size() < kFewest) continue;
    ResidualCell cell;
    const std::size_t column = c % static_cast<std::size_t>(map.columns);
    const std::size_t row = c / static_cast<std::size_t>(map.columns);
    cell.x = rx.low + (static_cast<double>(column) + 0.5) * wide / map.columns;
    cell.y = ry.low + (static_cast<double>(row) + 0.5) * tall / map.rows;
    cell.first = mean_residual(sample, members[0][c], groups);
    if (!component.empty()) cell.second = mean_residual(sample, members[1][c], groups);
    map.cells.push_back(cell);
  }
  return map;
}

}  // namespace lvcalib
