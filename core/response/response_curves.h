// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What figures of a boundary response show: its samples in classes.

#include <span>
#include <vector>

#include "response/boundary_response.h"

namespace lvcalib {

/// Samples of one class of distance.
struct TransitionBin {
  double distance_m = 0.0;  ///< Middle of the class, outside positive.
  double mean = 0.0;        ///< Of the intensities.
  double mean_sigma = 0.0;  ///< Its standard deviation; NaN for a single sample.
  int n = 0;
};

/// Mean intensity by signed distance, of the samples about the nodes in use, in classes of
/// `width_m` (positive), from the innermost to the outermost; empty classes are left out.
std::vector<TransitionBin> transition_curve(const SceneResponse& scene, double width_m = 1e-3);

/// Overlap samples of one class of range residual.
struct RangeBin {
  double low_m = 0.0;
  int n = 0;
};

/// Range residuals of the overlap samples of these scenes together in classes of `width_m`
/// (positive); empty classes are left out.
std::vector<RangeBin> range_histogram(std::span<const SceneResponse* const> scenes,
                                      double width_m = 2e-3);

}  // namespace lvcalib
