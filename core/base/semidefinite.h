// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace lvcalib {

/// A symmetric matrix with its negative eigenvalues set to zero: the nearest covariance of a
/// difference of covariances, which noise or rounding may have taken below zero.
template <int N>
Eigen::Matrix<double, N, N> without_negative_axes(const Eigen::Matrix<double, N, N>& m) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> axes(0.5 * (m + m.transpose()));
  return axes.eigenvectors() * axes.eigenvalues().cwiseMax(0.0).asDiagonal() *
         axes.eigenvectors().transpose();
}

}  // namespace lvcalib
