// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace lvcalib {

/// Standard deviation of one measurement where a spot sees a share `white` of white print, from
/// those on plain white and plain black: geometrically between the two, as noise follows a power of
/// the light that comes back.
inline double noise_between(double on_white, double on_black, double white) {
  return std::exp(white * std::log(on_white) + (1.0 - white) * std::log(on_black));
}

/// Variance of a return's intensity: that on plain print, whose standard deviation is
/// `plain_sigma`, and what the pointing jitter makes of it where the intensity changes with the
/// beam's direction.
inline double intensity_variance(double plain_sigma, const Eigen::RowVector2d& by_angle,
                                 const Eigen::Matrix2d& jitter_rad2) {
  return plain_sigma * plain_sigma +
         std::max(0.0, (by_angle * jitter_rad2 * by_angle.transpose()).value());
}

}  // namespace lvcalib
