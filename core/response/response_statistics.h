// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "response/boundary_response.h"

namespace lvcalib {

/// Overlap samples and what their region was chosen by.
struct OverlapSet {
  std::vector<const BoundarySample*> samples;
  std::vector<double> half_width_m;   ///< Of each sample's overlap region.
  std::vector<double> shift_m;        ///< δ of each sample's scene.
  double relative_width_sigma = 0.0;  ///< σ(σ)/σ of the transition that gave the widths.
  void append(const OverlapSet& other);
};

/// Angular covariance (pitch, yaw; rad²) whose across-edge variance explains the samples.
Eigen::Matrix2d angular_covariance(const OverlapSet& set);

/// Share of the angular covariance that scatters ranges along slanted boards, from the samples of
/// all scenes: ranges' variance = v(zone) + share·gᵀAg. Sigma 0 if the boards are too alike.
struct JitterShare {
  double share = 0.0;
  double sigma = 0.0;
};
JitterShare measure_jitter_share(const std::vector<const BoundarySample*>& samples,
                                 const Eigen::Matrix2d& angular);

/// Statistics of the samples; nothing with fewer than `min_samples` or if their edges do not turn
/// through enough directions to tell pitch from yaw.
std::optional<ResponseStatistics> summarize_response(const OverlapSet& set,
                                                     const JitterShare& jitter, int min_samples);

}  // namespace lvcalib
