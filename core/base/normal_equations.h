// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace lvcalib {

/// Solution of normal equations and its covariance.
struct NormalSolution {
  Eigen::VectorXd x;
  Eigen::MatrixXd covariance;
};

/// Solves N x = g. Scaled to a unit diagonal, so that metres, radians and pixels compare. Nothing
/// if N is not positive definite or does not determine some combination of the unknowns.
inline std::optional<NormalSolution> solve_normal_equations(const Eigen::MatrixXd& information,
                                                            const Eigen::VectorXd& gradient) {
  // Three digits above what double precision leaves of a difference.
  constexpr double kSingular = 1e-13;
  const Eigen::VectorXd unit = information.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Eigen::MatrixXd> factor(unit.asDiagonal() * information * unit.asDiagonal());
  if (factor.info() != Eigen::Success || !factor.isPositive() || factor.rcond() < kSingular)
    return std::nullopt;
  NormalSolution out;
  out.x = unit.asDiagonal() * factor.solve(unit.asDiagonal() * gradient);
  out.covariance = unit.asDiagonal() *
                   factor.solve(Eigen::MatrixXd::Identity(information.rows(), information.cols())) *
                   unit.asDiagonal();
  if (!out.x.allFinite() || !out.covariance.allFinite()) return std::nullopt;
  return out;
}

}  // namespace lvcalib
