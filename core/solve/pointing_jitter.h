// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <Eigen/Core>

namespace lvcalib {

/// Residuals are cut here (in σ) before they are squared and averaged, and the mean corrected for
/// what Gaussian noise loses: E[min(z², 9)] = 0.9904.
inline constexpr double kCut = 3.0;
inline constexpr double kCutMean = 0.9904;

/// What intensities scatter at the edges of the print beyond plain print: the variance of one is
/// σ² + Σ g² j, g how it changes with each of the beam's angles (1/rad), j the jitter's variance
/// along it (rad²).
class JitterRegression {
 public:
  /// An intensity with its residual, `by_angle` = g, σ² on plain print and the variance that it is
  /// thought to have.
  void add(const Eigen::RowVector2d& by_angle, double residual, double plain_variance,
           double variance);
  void add(const JitterRegression& other);
  /// Covariance of the jitter, rad², beam frame: never negative, never more than the whole blur.
  /// Nothing where no edge was seen.
  [[nodiscard]] std::optional<Eigen::Matrix2d> jitter_rad2(const Eigen::Matrix2d& blur_rad2) const;

 private:
  Eigen::Matrix2d normal_ = Eigen::Matrix2d::Zero();
  Eigen::Vector2d sums_ = Eigen::Vector2d::Zero();
};

}  // namespace lvcalib
