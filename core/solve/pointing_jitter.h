// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <Eigen/Core>

namespace lvcalib {

/// Residuals are cut here (in σ) before they are squared and averaged, and the mean corrected for
/// what Gaussian noise loses: E[min(z², 9)] = 0.9904.
inline constexpr double kCut = 3.0;
inline constexpr double kCutMean = 0.9904;

/// What intensities scatter at the edges of the print beyond plain print, by the jitter's variances
/// along the beam's two angles (rad²): a step of Fisher's scoring from those that are assumed.
class JitterRegression {
 public:
  /// An intensity with its residual, the variance that it has under the jitter assumed, and how
  /// that changes with it (see variance_by_jitter()).
  void add(double residual, double variance, const Eigen::Vector2d& by_jitter,
           const Eigen::Matrix2d& assumed_rad2);
  void add(const JitterRegression& other);
  /// Covariance of the jitter, rad², beam frame: never negative, never more than the whole blur.
  /// Nothing where no edge was seen.
  [[nodiscard]] std::optional<Eigen::Matrix2d> jitter_rad2(const Eigen::Matrix2d& blur_rad2) const;

 private:
  Eigen::Matrix2d normal_ = Eigen::Matrix2d::Zero();
  Eigen::Vector2d sums_ = Eigen::Vector2d::Zero();
};

}  // namespace lvcalib
