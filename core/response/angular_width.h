// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "response/boundary_response.h"

namespace lvcalib {

/// The transition's width as an ellipse of angles.
struct AngularWidth {
  Eigen::Matrix2d covariance_rad2 = Eigen::Matrix2d::Zero();  ///< Pitch, yaw.
  double delta_m = 0.0;         ///< Where the mid-level lies, outside positive.
  double relative_sigma = 0.0;  ///< Standard deviation of √trace over √trace.
};

/// Fits I = μ_in + (μ_out − μ_in)·Φ((d − δ)/√(bᵀAb)) over the samples, b their across-edge
/// gradient: the error-function transition whose width may differ with direction. Starts from the
/// samples' own width_m. Nothing without a transition.
std::optional<AngularWidth> fit_angular_width(const std::vector<const BoundarySample*>& samples);

}  // namespace lvcalib
