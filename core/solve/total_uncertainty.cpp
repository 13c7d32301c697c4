// SPDX-License-Identifier: BSD-3-Clause
#include "solve/total_uncertainty.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "base/parallel.h"

namespace lvcalib {
namespace {

// What one scene says about the faults, its own unknowns eliminated.
struct FaultTerm {
  Eigen::Matrix<double, Eigen::Dynamic, kRangeFaults> coupling;  // By the globals.
  Eigen::Matrix<double, kRangeFaults, kRangeFaults> information =
      Eigen::Matrix<double, kRangeFaults, kRangeFaults>::Zero();
};

FaultTerm fault_term(const ForwardScene& scene, std::size_t s, const BlurredPrint& print,
                     const ForwardSolution& solution, const ForwardOptions& options) {
  const Eigen::Index globals = solution.prior.sigma.size();
  FaultTerm out;
  out.coupling = Eigen::MatrixXd::Zero(globals, kRangeFaults);
  const SceneNoise& noise = solution.noise.scenes[s];
  const BoardReturns returns = select_returns(
      *scene.board_points, print, solution.state.lidar_from_board(s), solution.state.beam,
      {noise.range_white_m, noise.range_black_m}, options.selection);
  if (returns.size() == 0) return out;
  LinearizationOptions how;
  how.robust_threshold = options.robust_threshold;
  how.patch_m = options.patch_m;
  how.range_faults = true;
  SceneFit fit;
  const SceneEquations at =
      linearize_scene(scene, s, returns, print, solution.state, solution.noise, how, 1, fit);
  const Eigen::Index n = at.normal.rows() - globals;
  Eigen::MatrixXd own = at.normal.bottomRightCorner(n, n);
  for (std::size_t k = 0; k < kSceneErrors; ++k) {
    for (Eigen::Index i = 0; i < at.columns.count[k]; ++i) {
      const Eigen::Index u = kLocals + at.columns.first[k] + i;
      own(u, u) += 1.0 / (moves_board(k) ? kAbsentShared[k] : solution.noise.shared[k]);
    }
  }
  for (Eigen::Index i = 6; i < kLocals; ++i) {
    if (own(i, i) <= 0.0) own(i, i) = 1.0;
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(own);
  if (factor.info() != Eigen::Success) return out;
  const Eigen::MatrixXd& by = at.by_range_faults;
  const Eigen::MatrixXd eliminated = factor.solve(by.bottomRows(n));
  const FaultTerm term{by.topRows(globals) - at.normal.topRightCorner(globals, n) * eliminated,
                       at.range_faults - by.bottomRows(n).transpose() * eliminated};
  return term.coupling.allFinite() && term.information.allFinite() ? term : out;
}

}  // namespace

Matrix6d total_covariance(const std::vector<ForwardScene>& scenes, const BlurredPrint& print,
                          const ForwardSolution& solution, const LeftOutSizes& sizes,
                          const ForwardOptions& options, int threads) {
  const Matrix6d& own = solution.camera_from_lidar.covariance;
  std::vector<FaultTerm> faults(scenes.size());
  parallel_for(scenes.size(), threads, [&](std::size_t s) {
    if (solution.terms[s].usable) faults[s] = fault_term(scenes[s], s, print, solution, options);
  });
  const Eigen::Index globals = solution.prior.sigma.size();
  const Eigen::Index all = globals + kRangeFaults;
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(all, all);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(all);
  Eigen::VectorXd sigma = Eigen::VectorXd::Zero(all);
  sigma.head(globals) = solution.prior.sigma;
  for (Eigen::Index k = 0; k < kIntrinsics; ++k) {
    double& s = sigma(kFirstIntrinsic + k);
    if (!(s > 0.0)) s = sizes.intrinsics(k);
  }
  sigma.tail<kRangeFaults>() << sizes.range_offset_m, sizes.range_scale;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    if (!solution.terms[s].usable) continue;
    information.topLeftCorner(globals, globals) += solution.terms[s].information;
    gradient.head(globals) += solution.terms[s].gradient;
    information.topRightCorner(globals, kRangeFaults) += faults[s].coupling;
    information.bottomRightCorner<kRangeFaults, kRangeFaults>() += faults[s].information;
  }
  information.block<kIntrinsics, kIntrinsics>(kFirstIntrinsic, kFirstIntrinsic) +=
      solution.prior.evidence;
  gradient.segment<kIntrinsics>(kFirstIntrinsic) += solution.prior.evidence_gradient;
  information.bottomLeftCorner(kRangeFaults, globals) =
      information.topRightCorner(globals, kRangeFaults).transpose();
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
  if (!total.allFinite()) return own;
  // Estimation with more unknowns cannot be better; rounding may say so.
  Matrix6d more = total - own;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> axes(0.5 * (more + more.transpose()));
  more = axes.eigenvectors() * axes.eigenvalues().cwiseMax(0.0).asDiagonal() *
         axes.eigenvectors().transpose();
  return own + more;
}

}  // namespace lvcalib
