// SPDX-License-Identifier: GPL-3.0-or-later
#include "evidence_rigs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "simulation/dataset_writer.h"

namespace lvcalib::study {

std::string share_text(int hits, int count) {
  const double n = std::max(1, count);
  const double p = hits / n;
  constexpr double kZ = 1.96;
  const double middle = (p + kZ * kZ / (2 * n)) / (1 + kZ * kZ / n);
  const double half = kZ * std::sqrt(p * (1 - p) / n + kZ * kZ / (4 * n * n)) / (1 + kZ * kZ / n);
  char text[80];
  std::snprintf(text, sizeof text, "%d of %d (%.0f–%.0f %%)", hits, count,
                100 * std::max(0.0, middle - half), 100 * std::min(1.0, middle + half));
  return text;
}

std::string mean_text(const std::vector<double>& values) {
  double sum = 0.0;
  double square = 0.0;
  for (const double v : values) {
    sum += v;
    square += v * v;
  }
  const double n = std::max<double>(1.0, static_cast<double>(values.size()));
  const double mean = sum / n;
  const double variance = n > 1 ? (square - n * mean * mean) / (n - 1) : 0.0;
  char text[64];
  std::snprintf(text, sizeof text, "%.3f ± %.3f", mean,
                1.96 * std::sqrt(std::max(0.0, variance) / n));
  return text;
}

Result<CalibrationResult> calibrate_rig(const simulation::SimulatedRig& rig,
                                        const std::filesystem::path& folder) {
  const auto path = folder / ("evidence" + std::to_string(rig.options.seed));
  if (Status s = simulation::write_dataset(rig, path, true); !s) return s.error();
  const auto dataset = open_dataset(path);
  RunContext context;
  context.threads = 1;
  auto result =
      dataset ? calibrate(*dataset, {}, context) : Result<CalibrationResult>(dataset.error());
  std::filesystem::remove_all(path);
  std::filesystem::remove(path.string() + "-truth.json");
  return result;
}

}  // namespace lvcalib::study
