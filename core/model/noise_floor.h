// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "model/measurement_table.h"

namespace lvcalib {

/// Standard deviation of the range noise from pairs of neighbours on the board (same line and
/// print, a few millimetres apart), which no smooth effect can widen: √(mean d²/2),
/// outliers cut.
/// Zero if there are fewer than `min_pairs`.
double replicate_sigma(const std::vector<Eigen::Vector2d>& board_m,
                       const std::vector<double>& values, const std::vector<int>& strata,
                       double distance_m, int min_pairs);

/// Values of one print on one board; pairs of neighbours on the same line tell their noise.
class Replicates {
 public:
  void add(const BeamPoint& beam, double value) {
    at_.push_back(beam.board_m);
    values_.push_back(value);
    strata_.push_back(beam.line);
  }
  /// Zero if there are too few pairs even of farther neighbours.
  [[nodiscard]] double sigma() const;

 private:
  std::vector<Eigen::Vector2d> at_;
  std::vector<double> values_;
  std::vector<int> strata_;
};

/// Standard deviation (px) of a corner from what no smooth error can do: the alternating sum over
/// the four corners of a tag (or of a checkerboard's square), which has four times the variance of
/// a single corner. Insensitive to shifts, stretching and perspective of the tag, and to a bias
/// away from its centre. `fallback_px` where there are too few.
double corner_noise(const MeasurementTable& table, const ModelState& state, double fallback_px);

}  // namespace lvcalib
