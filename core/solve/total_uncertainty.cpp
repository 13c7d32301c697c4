// SPDX-License-Identifier: BSD-3-Clause
#include "solve/total_uncertainty.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "base/symmetric.h"

namespace lvcalib {
namespace {

// By how much the variance of Student's t with this freedom exceeds that of the normal
// distribution: ν/(ν − 2). Below three it has none, and three's is used.
double excess_variance(double freedom) {
  return 2.0 / (std::max(3.0, freedom) - 2.0);
}

}  // namespace

Matrix6d total_covariance(const ForwardSolution& solution, const LeftOutSizes& sizes) {
  const Matrix6d& own = solution.camera_from_lidar.covariance;
  const std::vector<FaultTerm>& faults = solution.faults;
  const Eigen::Index globals = solution.prior.sigma.size();
  const Eigen::Index all = globals + kFirstMotion;
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(all, all);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(all);
  Eigen::VectorXd sigma = Eigen::VectorXd::Zero(all);
  sigma.head(globals) = solution.prior.sigma;
  for (Eigen::Index k = 0; k < kIntrinsics; ++k) {
    double& s = sigma(kFirstIntrinsic + k);
    if (!(s > 0.0)) s = sizes.intrinsics(k);
  }
  sigma.tail<kFirstMotion>() = sizes.of_the_lidar();
  for (std::size_t s = 0; s < faults.size(); ++s) {
    if (!solution.terms[s].usable) continue;
    information.topLeftCorner(globals, globals) += solution.terms[s].information;
    gradient.head(globals) += solution.terms[s].gradient;
    information.topRightCorner(globals, kFirstMotion) +=
        faults[s].coupling.leftCols<kFirstMotion>();
    information.bottomRightCorner<kFirstMotion, kFirstMotion>() +=
        faults[s].information.topLeftCorner<kFirstMotion, kFirstMotion>();
  }
  information.block<kIntrinsics, kIntrinsics>(kFirstIntrinsic, kFirstIntrinsic) +=
      solution.prior.evidence;
  gradient.segment<kIntrinsics>(kFirstIntrinsic) += solution.prior.evidence_gradient;
  information.bottomLeftCorner(kFirstMotion, globals) =
      information.topRightCorner(globals, kFirstMotion).transpose();
  // In units of what each may be; the extrinsic in metres and radians.
  Eigen::VectorXd unit = sigma;
  unit.head<6>().setOnes();
  Eigen::MatrixXd scaled = unit.asDiagonal() * information * unit.asDiagonal();
  for (Eigen::Index i = 6; i < all; ++i) scaled(i, i) += 1.0;
  // Of the gradient only the held intrinsics' part is the data's: the rest stands at its minimum.
  Eigen::VectorXd asked = Eigen::VectorXd::Zero(all);
  for (Eigen::Index k = kFirstIntrinsic; k < kGlobals; ++k) {
    if (!(solution.prior.sigma(k) > 0.0)) asked(k) = gradient(k) * unit(k);
  }
  const Eigen::LDLT<Eigen::MatrixXd> factor(scaled);
  if (factor.info() != Eigen::Success || !factor.isPositive()) return own;
  const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(all, all));
  const Vector6d shift = factor.solve(asked).head<6>();
  Matrix6d total = inverse.topLeftCorner<6, 6>() + shift * shift.transpose();
  // Nor does the solution's own know how well few residuals tell their noise.
  total += excess_variance(solution.dof) * own;
  // Faults of the scans that are there, and what the data ask for of angles and origin that may be
  // there: what these do to the extrinsic is not in the solve.
  for (const ScanFault& fault : solution.scan_faults) {
    const Vector6d& move = fault.is_there() ? fault.move : fault.usual_move;
    total += move * move.transpose();
  }
  if (!total.allFinite()) return own;
  // Estimation with more unknowns cannot be better; rounding may say so.
  return own + without_negative_axes<6>(total - own);
}

}  // namespace lvcalib
