// SPDX-License-Identifier: BSD-3-Clause
#include "solve/scan_faults.h"

#include <algorithm>
#include <cmath>

#include "base/statistics.h"
#include "base/symmetric.h"
#include "solve/total_uncertainty.h"

namespace lvcalib {
namespace {

// Of all tests together, by chance: as for bumps between scenes. Users run hundreds of data sets.
constexpr double kFalseAlarm = 0.001;
// Directions among a kind's columns of which the nuisances leave less than this share are not
// tested: sums of 10⁵ rows in doubles leave rounding below it,
constexpr double kLeastResolved = 1e-6;
// and of what moves the scan as a motion of the LiDAR does, second order of the last step. Scales,
// eccentricity and tilt have directions that are a rotation up to a share of 10⁻⁷ to 10⁻³, where χ²
// was up to 1000 on clean rigs, and others from a tenth on; the origin's begin at 7·10⁻⁴, where χ²
// was as it should be.
constexpr double kLeastResolvedOfAngles = 1e-2;
constexpr double kLeastResolvedOfOrigin = 5e-4;
// How fast a board that is held, or a rig that rolls, moves (one σ), and how long detectors trail;
// angles and origins as what is left out of a solve (see LeftOutSizes). They draw to zero what the
// rows hardly tell, so that the extrinsic's move is not noise.
constexpr double kUsualSpeed_m_s = 0.1;
constexpr double kUsualLag_s = 2e-5;

// Angles and origins that are there may be so many times their usual size: devices are known whose
// beams start 30 mm beside the origin, ten times what is usual.
constexpr double kUnusual = 10.0;

// The fault columns of one kind.
struct Columns {
  int first = 0;
  Eigen::VectorXd usual;
};
Columns columns_of(ScanFault::Kind kind) {
  const auto left_out = LeftOutSizes{}.of_the_lidar();
  switch (kind) {
    case ScanFault::Kind::kMotion:
      return {kFirstMotion, Eigen::VectorXd::Constant(kMotionFaults, kUsualSpeed_m_s)};
    case ScanFault::Kind::kLag:
      return {kLagFault, Eigen::VectorXd::Constant(1, kUsualLag_s)};
    case ScanFault::Kind::kAngles:
      return {kFirstAngle, left_out.segment<kAngleFaults>(kFirstAngle)};
    case ScanFault::Kind::kOrigin:
      break;
  }
  return {kFirstOrigin, left_out.segment<kOriginFaults>(kFirstOrigin)};
}

// What the rows say of the fault columns of one kind, all else eliminated.
ScanFault score_test(ScanFault::Kind kind, const std::vector<const FaultTerm*>& terms,
                     const GlobalSolution& solved, double chance) {
  const Columns columns = columns_of(kind);
  const int first = columns.first;
  const auto count = static_cast<int>(columns.usual.size());
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
  const auto axes = axes_of<Eigen::Dynamic>(0.5 * (left + left.transpose()));
  const double least = kind == ScanFault::Kind::kAngles   ? kLeastResolvedOfAngles
                       : kind == ScanFault::Kind::kOrigin ? kLeastResolvedOfOrigin
                                                          : kLeastResolved;
  int dof = 0;  // The last ones: shares come in rising order.
  for (Eigen::Index k = 0; k < count; ++k) {
    if (!(axes.values(k) > least)) continue;
    out.chi_square += std::pow(axes.vectors.col(k).dot(asked), 2) / axes.values(k);
    ++dof;
  }
  if (dof == 0) return out;
  out.gate = chi_square_gate(dof, chance);
  const Eigen::MatrixXd tested = axes.vectors.rightCols(dof);
  // Inverse information of the tested directions, with the fault drawn to zero by a size.
  const auto inverse_of = [&](const Eigen::VectorXd& size) -> Eigen::MatrixXd {
    Eigen::MatrixXd drawn = left;
    drawn.diagonal() += unit.cwiseQuotient(size).cwiseAbs2();
    return tested * (tested.transpose() * drawn * tested).inverse() * tested.transpose();
  };
  const bool sized = kind == ScanFault::Kind::kAngles || kind == ScanFault::Kind::kOrigin;
  const Eigen::MatrixXd inverse = inverse_of(sized ? kUnusual * columns.usual : columns.usual);
  const Eigen::MatrixXd covariance = unit.asDiagonal() * inverse * unit.asDiagonal();
  const Eigen::VectorXd fault = unit.cwiseProduct(inverse * asked);
  if (sized) {
    out.usual_move = -(answer * unit.cwiseProduct(inverse_of(columns.usual) * asked)).head<6>();
  }
  out.size = kind == ScanFault::Kind::kLag      ? fault(0)
             : kind == ScanFault::Kind::kAngles ? fault.cwiseAbs().maxCoeff()
                                                : fault.norm();
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
  // Whether any scene's rows tell of the columns from `first` on.
  const auto any_has = [&](int first) {
    return std::any_of(scenes.begin(), scenes.end(), [&](const SceneEquations& scene) {
      return scene.faults.diagonal().tail(kFaults - first).maxCoeff() > 0.0;
    });
  };
  if (!any_has(0)) return {};
  const GlobalSolution solved =
      solve_equations(scenes, prior, sensor, variances, {BoardMotion::kWeighed, false, threads});
  if (!solved.solvable) return {};
  std::vector<FaultTerm> terms;
  for (const SceneEquations& scene : scenes)
    terms.push_back(fault_term(scene, variances, BoardMotion::kWeighed));
  std::vector<const FaultTerm*> all;
  for (const FaultTerm& term : terms) all.push_back(&term);
  const double chance = kFalseAlarm / static_cast<double>(scenes.size() + 4);
  std::vector<ScanFault> out{score_test(ScanFault::Kind::kAngles, all, solved, chance),
                             score_test(ScanFault::Kind::kOrigin, all, solved, chance)};
  if (!any_has(kFirstMotion)) return out;
  out.push_back(score_test(ScanFault::Kind::kLag, all, solved, chance));
  out.push_back(score_test(ScanFault::Kind::kMotion, all, solved, chance));
  if (out.back().is_there() || scenes.size() < 2) return out;
  for (std::size_t s = 0; s < terms.size(); ++s) {
    out.push_back(score_test(ScanFault::Kind::kMotion, {&terms[s]}, solved, chance));
    out.back().scene = s;
  }
  return out;
}

}  // namespace lvcalib
