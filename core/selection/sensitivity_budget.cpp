// SPDX-License-Identifier: BSD-3-Clause
#include "selection/sensitivity_budget.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Cholesky>

#include "base/statistics.h"
#include "base/symmetric.h"
#include "model/camera_intrinsics.h"
#include "selection/effect_search.h"
#include "solve/total_uncertainty.h"

namespace lvcalib {
namespace {

using Moves = Eigen::Matrix<double, 6, Eigen::Dynamic>;

// Movement of the extrinsic by one unit of each of the fit's last p unknowns, when they are left
// out.
Moves moves_if_omitted(const ModelFit& fit, Eigen::Index p) {
  Eigen::MatrixXd h = fit.prior.information;
  for (const SceneTerm& scene : fit.scenes) h += scene.information;
  const Eigen::Index q = h.rows() - p;
  return h.topLeftCorner(q, q).ldlt().solve(h.topRightCorner(q, p)).topRows<6>();
}

double root_trace(const Matrix6d& moment, int first) {
  return std::sqrt(std::max(0.0, moment.diagonal().segment<3>(first).sum()));
}

BudgetItem item_of(const EffectColumns& columns, const Candidate& candidate) {
  BudgetItem out;
  out.id = columns.effect->info().id;
  const Eigen::Index p = columns.count();
  const Eigen::VectorXd theta = candidate.fit.solution.tail(p);
  const Eigen::MatrixXd sigma = candidate.fit.covariance.bottomRightCorner(p, p);
  double largest = -1.0;
  // From the sum of squares to the square of the sum, so that one parameter gives its own limit.
  double from_squares = 1.0;
  for (Eigen::Index k = 0; k < p; ++k) {
    const EffectParameter& parameter = columns.parameters[static_cast<std::size_t>(k)];
    const double spread = kUpper95 * std::sqrt(std::max(0.0, sigma(k, k)));
    const double limit = std::abs(theta(k)) + spread;
    const double squares = theta(k) * theta(k) + spread * spread;
    if (squares > 0.0) from_squares = std::max(from_squares, limit * limit / squares);
    if (limit / parameter.size_of_interest <= largest) continue;
    largest = limit / parameter.size_of_interest;
    out.parameter = parameter.name;
    out.unit = parameter.unit;
    out.size = limit / parameter.unit_in_si;
  }
  const Moves moves = moves_if_omitted(candidate.fit, p);
  out.moment = moves * (theta * theta.transpose() + sigma) * moves.transpose();
  const Matrix6d limit =
      from_squares *
      (moves * (theta * theta.transpose() + kUpper95 * kUpper95 * sigma) * moves.transpose());
  out.translation_mm = 1e3 * root_trace(limit, 0);
  out.rotation_mrad = 1e3 * root_trace(limit, 3);
  return out;
}

// The faults that a calibration's total uncertainty holds: those that the data are asked for
// (angles, origin, intrinsics), then ranges.
std::vector<EffectSearch::LeftOutGroup> left_out_effects(const MeasurementTable& table,
                                                         const LeftOutSizes& sizes) {
  const auto of_the_lidar = sizes.of_the_lidar();
  EffectSearch::LeftOutGroup ranges, angles, origin;
  for (const EffectPtr& effect : effect_catalogue()) {
    EffectSearch::LeftOutGroup* group = nullptr;
    const auto parameters = effect->parameters(table);
    Eigen::VectorXd sigma = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters.size()));
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      if (!parameters[k].device_fault) continue;
      const DeviceFault fault = *parameters[k].device_fault;
      sigma(static_cast<Eigen::Index>(k)) = of_the_lidar(static_cast<Eigen::Index>(fault));
      const FaultKind kind = kind_of(fault);
      group = kind == FaultKind::kRange ? &ranges : kind == FaultKind::kAngle ? &angles : &origin;
    }
    if (group != nullptr) group->push_back({effect, sigma});
  }
  return {angles, origin, {{camera_intrinsics(), sizes.intrinsics}}, ranges};
}

}  // namespace

std::optional<Matrix6d> total_covariance(const EffectSearch& search, const Matrix6d& own,
                                         const LeftOutSizes& sizes) {
  constexpr std::size_t kAsked = 3;  // Groups, from the first on.
  const ModelFit& fit = search.reference().fit;
  const auto with = search.fits_with(left_out_effects(search.table(), sizes));
  if (with.empty()) return std::nullopt;
  // Estimation with more unknowns cannot be better; rounding may say so.
  Matrix6d more = without_negative_axes<6>(with.front().covariance.topLeftCorner<6, 6>() -
                                           fit.covariance.topLeftCorner<6, 6>());
  for (std::size_t k = 1; k <= kAsked; ++k) {
    const Vector6d asked = with[k].solution.head<6>() - fit.solution.head<6>();
    more += asked * asked.transpose();
  }
  if (!more.allFinite()) return own;
  return own + more;
}

std::vector<BudgetItem> sensitivity_budget(const EffectSearch& search) {
  const auto& columns = search.linear().columns.list();
  // Of several shape numbers the worst counts.
  std::map<std::string, BudgetItem> worst;
  for (const Candidate& candidate : search.candidates()) {
    if (candidate.fit.scenes.empty()) continue;
    BudgetItem item = item_of(columns[candidate.columns], candidate);
    const auto at = worst.find(item.id);
    if (at == worst.end() || item.translation_mm > at->second.translation_mm)
      worst[item.id] = std::move(item);
  }
  std::vector<BudgetItem> out;
  for (auto& [id, item] : worst) out.push_back(std::move(item));
  std::stable_sort(out.begin(), out.end(), [](const BudgetItem& a, const BudgetItem& b) {
    return a.translation_mm > b.translation_mm;
  });
  return out;
}

Matrix6d covariance_with_budget(const Matrix6d& covariance, const std::vector<BudgetItem>& budget) {
  Matrix6d out = covariance;
  for (const BudgetItem& item : budget) out += item.moment;
  return out;
}

}  // namespace lvcalib
