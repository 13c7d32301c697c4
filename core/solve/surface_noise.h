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

/// What the pointing jitter J adds to the variance of an intensity where the print bends under the
/// beam, beside an edge: ½ tr((∇∇ᵀA J)²), with `by_blur` the mean intensity's change with the blur
/// (hh, hv, vv), ½∇∇ᵀA. As A is blurred by J, the variance is that and gᵀJg, and higher
/// derivatives.
inline double bent_variance(const Eigen::RowVector3d& by_blur, const Eigen::Matrix2d& jitter_rad2) {
  Eigen::Matrix2d half;
  half << by_blur(0), 0.5 * by_blur(1), 0.5 * by_blur(1), by_blur(2);
  const Eigen::Matrix2d bent = half * jitter_rad2;
  return 2.0 * std::max(0.0, (bent * bent).trace());
}

/// How the variance of an intensity changes with the jitter's along each of the beam's angles.
inline Eigen::Vector2d variance_by_jitter(const Eigen::RowVector2d& by_angle,
                                          const Eigen::RowVector3d& by_blur,
                                          const Eigen::Matrix2d& jitter_rad2) {
  const Eigen::Array3d bend2 = by_blur.transpose().array().square();
  const double h = jitter_rad2(0, 0);
  const double v = jitter_rad2(1, 1);
  return {by_angle(0) * by_angle(0) + 4.0 * bend2(0) * h + bend2(1) * v,
          by_angle(1) * by_angle(1) + 4.0 * bend2(2) * v + bend2(1) * h};
}

/// Variance of a return's intensity: that on plain print, whose standard deviation is
/// `plain_sigma`, and what the pointing jitter makes of it where the intensity changes with the
/// beam's direction.
inline double intensity_variance(double plain_sigma, const Eigen::RowVector2d& by_angle,
                                 const Eigen::RowVector3d& by_blur,
                                 const Eigen::Matrix2d& jitter_rad2) {
  return plain_sigma * plain_sigma +
         std::max(0.0, (by_angle * jitter_rad2 * by_angle.transpose()).value()) +
         bent_variance(by_blur, jitter_rad2);
}

}  // namespace lvcalib
