// SPDX-License-Identifier: BSD-3-Clause
#include "solve/scan_faults.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "base/statistics.h"

namespace lvcalib {
namespace {

// Of all tests together, by chance: as for bumps between scenes. Users run hundreds of data sets.
constexpr double kFalseAlarm = 0.001;
// Directions of a velocity of which the nuisances leave less than this share are not tested: sums
// of 10⁵ rows in doubles leave rounding below it.
constexpr double kLeastShare = 1e-6;
// How fast a board that is held, or a rig that rolls, moves (one σ), and how long detectors trail:
// draws to zero what the rows hardly tell, so that the extrinsic's move is not noise.
constexpr double kUsualSpeed_m_s = 0.1;
constexpr double kUsualLag_s = 2e-5;

// What the rows say of the fault columns of one kind, all else eliminated.
ScanFault score_test(ScanFault::Kind kind, const std::vector<const FaultTerm*>& terms,
                     const GlobalSolution& solved, double chance) {
  const bool motion = kind == ScanFault::Kind::kMotion;
  const int first = motion ? kFirstMotion : kLagFault;
  const int count = motion ? kMotionFaults : 1;
  Eigen::MatrixXd coupling = Eigen::MatrixXd::Zero(solved.globals.size(), count);
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(count);
  for (const FaultTerm* term : terms) {
    coupling += term->coupling.middleCols(first, count);
    information += term->information.block(first, first, count, count);
    gradient += term->gradient.segment(first, count).transpose();
  }
  ScanFault out;
  out.kind = kind;
  out.gate = HUGE_VAL;
  if (!(information.diagonal().minCoeff() > 0.0)) return out;
  const Eigen::MatrixXd answer = solved.covariance * coupling;  // A⁻¹B
  const Eigen::VectorXd unit = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd left =
      unit.asDiagonal() * (information - coupling.transpose() * answer) * unit.asDiagonal();
  const Eigen::VectorXd asked = unit.cwiseProduct(gradient - coupling.transpose() * solved.globals);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(0.5 * (left + left.transpose()));
  int dof = 0;
  for (Eigen::Index k = 0; k < count; ++k) {
    if (!(axes.eigenvalues()(k) > kLeastShare)) continue;
    out.chi_square += std::pow(axes.eigenvectors().col(k).dot(asked), 2) / axes.eigenvalues()(k);
    ++dof;
  }
  if (dof == 0) return out;
  out.gate = chi_square_gate(dof, chance);
  const double usual = motion ? kUsualSpeed_m_s : kUsualLag_s;
  Eigen::MatrixXd drawn = left;
  drawn.diagonal() += (unit / usual).cwiseAbs2();
  const Eigen::MatrixXd covariance = unit.asDiagonal() * drawn.inverse() * unit.asDiagonal();
  const Eigen::VectorXd fault = unit.cwiseProduct(drawn.ldlt().solve(asked));
  out.size = motion ? fault.norm() : fault(0);
  const Eigen::VectorXd along =
      fault.norm() > 0.0 ? Eigen::VectorXd(fault.normalized()) : Eigen::VectorXd::Unit(count, 0);
  out.sigma = std::sqrt(along.dot(covariance * along));
  out.move = -(answer * fault).head<6>();
  return out;
}

}  // namespace

std::vector<ScanFault> find_scan_faults(const std::vector<SceneEquations>& scenes,
                                        const GlobalPrior& prior, const SensorErrors& sensor,
                                        const SharedVariances& variances, int threads) {
  const auto is_timed = [](const SceneEquations& scene) {
    return scene.faults.diagonal().tail<kFaults - kRangeFaults>().maxCoeff() > 0.0;
  };
  if (std::none_of(scenes.begin(), scenes.end(), is_timed)) return {};
  const GlobalSolution solved =
      solve_equations(scenes, prior, sensor, variances, BoardMotion::kWeighed, false, threads);
  if (!solved.solvable) return {};
  std::vector<FaultTerm> terms;
  for (const SceneEquations& scene : scenes)
    terms.push_back(fault_term(scene, variances, BoardMotion::kWeighed));
  std::vector<const FaultTerm*> all;
  for (const FaultTerm& term : terms) all.push_back(&term);
  const double chance = kFalseAlarm / static_cast<double>(scenes.size() + 2);
  std::vector<ScanFault> out{score_test(ScanFault::Kind::kMotion, all, solved, chance),
                             score_test(ScanFault::Kind::kLag, all, solved, chance)};
  if (out.front().is_there() || scenes.size() < 2) return out;
  for (std::size_t s = 0; s < terms.size(); ++s) {
    out.push_back(score_test(ScanFault::Kind::kMotion, {&terms[s]}, solved, chance));
    out.back().scene = s;
  }
  return out;
}

}  // namespace lvcalib
