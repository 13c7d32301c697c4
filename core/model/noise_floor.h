// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "model/measurement_table.h"

namespace lvcalib {

/// Standard deviation of the range noise from pairs of neighbours on the board (same line and
/// print, a few millimetres apart), which no smooth effect can widen: √(median d²/2/0.455).
/// Zero if there are fewer than `min_pairs`.
double replicate_sigma(const std::vector<Eigen::Vector2d>& board_m,
                       const std::vector<double>& values, const std::vector<int>& strata,
                       double distance_m, int min_pairs);

/// Standard deviation (px) of a corner from what no smooth error can do: the alternating sum over
/// the four corners of a tag (or of a checkerboard's square), which has four times the variance of
/// a single corner. Insensitive to shifts, stretching and perspective of the tag, and to a bias
/// away from its centre. `fallback_px` where there are too few.
double corner_noise(const MeasurementTable& table, const ModelState& state, double fallback_px);

}  // namespace lvcalib
