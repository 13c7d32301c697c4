// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace lvcalib {

// What is asked of covariances and information matrices. Eigen's solvers take a compiler seconds
// for each size in each source, so that one source has them, for the sizes that somebody asks for
// (its last lines); another size does not link until it is added there.

/// Eigenvalues in ascending order and, as columns in the same order, unit eigenvectors.
template <int N>
struct SymmetricAxes {
  Eigen::Matrix<double, N, 1> values;
  Eigen::Matrix<double, N, N> vectors;
};

/// Eigenvalues and eigenvectors of a symmetric matrix by QR steps. Only its lower triangle is read;
/// what holds a NaN gives NaN.
template <int N>
SymmetricAxes<N> axes_of(const Eigen::Matrix<double, N, N>& m);

/// A symmetric matrix with its negative eigenvalues set to zero: the nearest covariance of a
/// difference of covariances, which noise or rounding may have taken below zero.
template <int N>
Eigen::Matrix<double, N, N> without_negative_axes(const Eigen::Matrix<double, N, N>& m);

/// Standard deviation along the longest axis of a covariance.
double largest_sigma(const Eigen::Matrix3d& covariance);

/// Squared Mahalanobis distance xᵀ C⁻¹ x; meaningless where C is not positive definite.
template <int N>
double squared_mahalanobis(const Eigen::Matrix<double, N, 1>& x,
                           const Eigen::Matrix<double, N, N>& covariance);

/// Inverse of a positive definite matrix by its factors LDLᵀ; meaningless where it is none.
template <int N>
Eigen::Matrix<double, N, N> symmetric_inverse(const Eigen::Matrix<double, N, N>& m);

}  // namespace lvcalib
