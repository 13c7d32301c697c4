// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/feature_problem.h"

namespace lvcalib {

/// Every board pose from its own corners alone, and the corner noise that they then show. Nothing
/// the LiDAR says can widen it: otherwise a scene that contradicts the others would be explained
/// by noisy corners.
struct CornerFit {
  std::vector<Rigid3> camera_from_board;  ///< Per scene; the start value for scenes not in use.
  double sigma_px = 0.0;  ///< √(χ²/redundancy) over all used scenes, robust weights applied.
};

/// Fits the poses from the starts in `scenes` (Huber weights at options.robust_threshold, noise
/// re-estimated until it stands still). Sigma is never below options.sigma_px_floor.
CornerFit fit_corners(const FeatureInput& in, const ObservationMask& mask);

}  // namespace lvcalib
