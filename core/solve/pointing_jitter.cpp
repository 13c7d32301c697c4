// SPDX-License-Identifier: BSD-3-Clause
#include "solve/pointing_jitter.h"

#include <algorithm>

#include <Eigen/Cholesky>

namespace lvcalib {

void JitterRegression::add(const Eigen::RowVector2d& by_angle, double residual,
                           double plain_variance, double variance) {
  const Eigen::Vector2d g = by_angle.transpose().cwiseAbs2();
  const double beyond =
      std::min(residual * residual, kCut * kCut * variance) / kCutMean - plain_variance;
  const double weight = 1.0 / (variance * variance);
  normal_ += weight * g * g.transpose();
  sums_ += weight * beyond * g;
}

void JitterRegression::add(const JitterRegression& other) {
  normal_ += other.normal_;
  sums_ += other.sums_;
}

std::optional<Eigen::Matrix2d> JitterRegression::jitter_rad2(
    const Eigen::Matrix2d& blur_rad2) const {
  if (!(normal_.trace() > 0.0)) return std::nullopt;
  Eigen::Vector2d j = normal_.ldlt().solve(sums_);
  for (Eigen::Index k = 0; k < 2; ++k) {
    if (j(k) >= 0.0) continue;
    const Eigen::Index other = 1 - k;
    j(k) = 0.0;
    j(other) = std::max(0.0, sums_(other) / normal_(other, other));
  }
  return Eigen::Matrix2d(j.cwiseMin(blur_rad2.diagonal()).asDiagonal());
}

}  // namespace lvcalib
