// SPDX-License-Identifier: BSD-3-Clause
#include "base/symmetric.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace lvcalib {

template <int N>
SymmetricAxes<N> axes_of(const Eigen::Matrix<double, N, N>& m) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(m);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template <int N>
Eigen::Matrix<double, N, N> without_negative_axes(const Eigen::Matrix<double, N, N>& m) {
  const SymmetricAxes<N> axes = axes_of<N>(0.5 * (m + m.transpose()));
  return axes.vectors * axes.values.cwiseMax(0.0).asDiagonal() * axes.vectors.transpose();
}

double largest_sigma(const Eigen::Matrix3d& covariance) {
  return std::sqrt(std::max(0.0, axes_of(covariance).values(2)));
}

template <int N>
double squared_mahalanobis(const Eigen::Matrix<double, N, 1>& x,
                           const Eigen::Matrix<double, N, N>& covariance) {
  return x.dot(covariance.ldlt().solve(x));
}

template <int N>
Eigen::Matrix<double, N, N> symmetric_inverse(const Eigen::Matrix<double, N, N>& m) {
  return m.ldlt().solve(Eigen::Matrix<double, N, N>::Identity(m.rows(), m.cols()));
}

template SymmetricAxes<2> axes_of(const Eigen::Matrix2d&);
template SymmetricAxes<3> axes_of(const Eigen::Matrix3d&);
template SymmetricAxes<6> axes_of(const Eigen::Matrix<double, 6, 6>&);
template SymmetricAxes<Eigen::Dynamic> axes_of(const Eigen::MatrixXd&);
template Eigen::Matrix2d without_negative_axes(const Eigen::Matrix2d&);
template Eigen::Matrix<double, 6, 6> without_negative_axes(const Eigen::Matrix<double, 6, 6>&);
template double squared_mahalanobis(const Eigen::Vector2d&, const Eigen::Matrix2d&);
template double squared_mahalanobis(const Eigen::Matrix<double, 6, 1>&,
                                    const Eigen::Matrix<double, 6, 6>&);
template double squared_mahalanobis(const Eigen::VectorXd&, const Eigen::MatrixXd&);
template Eigen::Matrix3d symmetric_inverse(const Eigen::Matrix3d&);
template Eigen::Matrix<double, 6, 6> symmetric_inverse(const Eigen::Matrix<double, 6, 6>&);
template Eigen::MatrixXd symmetric_inverse(const Eigen::MatrixXd&);

}  // namespace lvcalib
