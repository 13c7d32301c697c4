// SPDX-License-Identifier: BSD-3-Clause
#include "solve/global_solution.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>

#include "base/normal_equations.h"
#include "base/parallel.h"

namespace lvcalib {
namespace {

// The kind of the sensor's error number i.
std::size_t sensor_kind(Eigen::Index i) {
  return static_cast<std::size_t>(i == 0   ? SharedError::kSensorRange
                                  : i == 1 ? SharedError::kSensorDark
                                           : SharedError::kSensorLine);
}

// K D Kᵀ with K how the eliminated gradient answers to a motion of the board of variances D.
Eigen::MatrixXd board_spread(const SceneEquations& scene, const Eigen::MatrixXd& to_globals,
                             const SharedVariances& variances) {
  const Eigen::Index globals = scene.globals;
  const Eigen::Index n = scene.normal.rows() - globals;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(globals, globals);
  for (std::size_t k = 0; k < kSceneErrors; ++k) {
    if (!moves_board(k) || variances[k] <= kAbsentShared[k]) continue;
    for (Eigen::Index i = 0; i < scene.columns.count[k]; ++i) {
      const Eigen::Index at = globals + kLocals + scene.columns.first[k] + i;
      const Eigen::VectorXd by = scene.normal.col(at).head(globals) -
                                 to_globals.transpose() * scene.normal.col(at).tail(n);
      out += variances[k] * by * by.transpose();
    }
  }
  return out;
}

bool is_weighed(std::size_t kind, BoardMotion motion) {
  return motion == BoardMotion::kWeighed || !moves_board(kind);
}

// The scene's equations for its own unknowns, with the priors of its shared errors; of a kind that
// is not weighed, as if there were none.
Eigen::MatrixXd own_equations(const SceneEquations& scene, const SharedVariances& variances,
                              BoardMotion motion) {
  const Eigen::Index n = scene.normal.rows() - scene.globals;
  Eigen::MatrixXd own = scene.normal.bottomRightCorner(n, n);
  for (std::size_t k = 0; k < kSceneErrors; ++k) {
    for (Eigen::Index i = 0; i < scene.columns.count[k]; ++i) {
      const Eigen::Index u = kLocals + scene.columns.first[k] + i;
      own(u, u) += 1.0 / (is_weighed(k, motion) ? variances[k] : kAbsentShared[k]);
    }
  }
  // Levels without any intensity row are nobody's.
  for (Eigen::Index i = 6; i < kLocals; ++i) {
    if (own(i, i) <= 0.0) own(i, i) = 1.0;
  }
  return own;
}

// Their right hand side.
Eigen::VectorXd own_gradient(const SceneEquations& scene, const SharedVariances& variances,
                             BoardMotion motion) {
  Eigen::VectorXd gradient = scene.gradient.tail(scene.gradient.size() - scene.globals);
  for (std::size_t k = 0; k < kSceneErrors; ++k) {
    for (Eigen::Index i = 0; i < scene.columns.count[k]; ++i) {
      const Eigen::Index u = scene.columns.first[k] + i;
      gradient(kLocals + u) -=
          scene.shared(u) / (is_weighed(k, motion) ? variances[k] : kAbsentShared[k]);
    }
  }
  return gradient;
}

}  // namespace

std::optional<GlobalStep> solve_terms(const std::vector<const GlobalTerm*>& terms,
                                      const GlobalPrior& prior) {
  const Eigen::Index globals = prior.sigma.size();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(globals, globals);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(globals);
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(globals, globals);
  for (const GlobalTerm* term : terms) {
    if (!term->usable) continue;
    information += term->information;
    gradient += term->gradient;
    spread += term->spread;
  }
  if (!(information.topLeftCorner<6, 6>().diagonal().minCoeff() > 0.0)) return std::nullopt;
  information.block<kIntrinsics, kIntrinsics>(kFirstIntrinsic, kFirstIntrinsic) += prior.evidence;
  gradient.segment<kIntrinsics>(kFirstIntrinsic) += prior.evidence_gradient;
  const auto held = [&](Eigen::Index i) { return i >= 6 && !(prior.sigma(i) > 0.0); };
  for (Eigen::Index i = 6; i < globals; ++i) {
    if (!held(i)) {
      information(i, i) += 1.0 / (prior.sigma(i) * prior.sigma(i));
      gradient(i) -= prior.offset(i) / (prior.sigma(i) * prior.sigma(i));
      continue;
    }
    information.row(i).setZero();
    information.col(i).setZero();
    information(i, i) = 1.0;
    gradient(i) = 0.0;
  }
  auto solved = solve_normal_equations(information, gradient);
  if (!solved) return std::nullopt;
  GlobalStep out;
  out.step = std::move(solved->x);
  out.covariance = std::move(solved->covariance);
  for (Eigen::Index i = 6; i < globals; ++i) {
    if (!held(i)) continue;
    out.covariance.row(i).setZero();
    out.covariance.col(i).setZero();
  }
  out.covariance += out.covariance * spread * out.covariance;
  out.decrement = out.step.dot(gradient);
  return out;
}

FaultTerm fault_term(const SceneEquations& scene, const SharedVariances& variances,
                     BoardMotion motion) {
  const Eigen::Index globals = scene.globals;
  FaultTerm out;
  out.coupling = Eigen::MatrixXd::Zero(globals, kFaults);
  const Eigen::Index n = scene.normal.rows() - globals;
  if (n <= 0 || scene.by_faults.rows() == 0) return out;
  const Eigen::LLT<Eigen::MatrixXd> factor(own_equations(scene, variances, motion));
  if (factor.info() != Eigen::Success) return out;
  const Eigen::MatrixXd& by = scene.by_faults;
  const Eigen::MatrixXd eliminated = factor.solve(by.bottomRows(n));
  const FaultTerm term{
      by.topRows(globals) - scene.normal.topRightCorner(globals, n) * eliminated,
      scene.faults - by.bottomRows(n).transpose() * eliminated,
      scene.fault_gradient - own_gradient(scene, variances, motion).transpose() * eliminated};
  return term.coupling.allFinite() && term.information.allFinite() && term.gradient.allFinite()
             ? term
             : out;
}

void GlobalPrior::set_sensor(const SensorErrors& sensor, const SharedVariances& variances) {
  const Eigen::Index count = sensor.count();
  sigma.conservativeResize(kGlobals + count);
  offset.conservativeResize(kGlobals + count);
  for (Eigen::Index i = 0; i < count; ++i) {
    sigma(kGlobals + i) = std::sqrt(variances[sensor_kind(i)]);
    offset(kGlobals + i) = sensor.values.size() == count ? sensor.values(i) : 0.0;
  }
}

GlobalSolution solve_equations(const std::vector<SceneEquations>& scenes, GlobalPrior prior,
                               const SensorErrors& sensor, const SharedVariances& variances,
                               const EliminationOptions& how) {
  const auto weighed = [&](std::size_t kind) { return is_weighed(kind, how.motion); };
  GlobalSolution out;
  const Eigen::Index globals = scenes.front().globals;
  if (globals > kGlobals) prior.set_sensor(sensor, variances);
  struct Eliminated {
    Eigen::LLT<Eigen::MatrixXd> own;
    Eigen::MatrixXd to_globals;  // own⁻¹ · coupling
    Eigen::VectorXd rest;        // own⁻¹ · gradient
  };
  std::vector<Eliminated> parts(scenes.size());
  out.terms.resize(scenes.size());
  parallel_for(scenes.size(), how.threads, [&](std::size_t s) {
    const SceneEquations& scene = scenes[s];
    const Eigen::Index n = scene.normal.rows() - globals;
    if (n <= 0) return;
    const Eigen::VectorXd gradient = own_gradient(scene, variances, how.motion);
    Eliminated& part = parts[s];
    part.own.compute(own_equations(scene, variances, how.motion));
    if (part.own.info() != Eigen::Success) return;
    const Eigen::MatrixXd coupling = scene.normal.bottomLeftCorner(n, globals);
    part.to_globals = part.own.solve(coupling);
    part.rest = part.own.solve(gradient);
    GlobalTerm& term = out.terms[s];
    term.information =
        scene.normal.topLeftCorner(globals, globals) - coupling.transpose() * part.to_globals;
    term.gradient = scene.gradient.head(globals) - coupling.transpose() * part.rest;
    term.spread = how.motion == BoardMotion::kWidens
                      ? board_spread(scene, part.to_globals, variances)
                      : Eigen::MatrixXd::Zero(globals, globals);
    term.usable = term.information.allFinite() && term.gradient.allFinite();
  });
  std::vector<const GlobalTerm*> terms;
  for (const GlobalTerm& term : out.terms) terms.push_back(&term);
  const auto solved = solve_terms(terms, prior);
  if (!solved) return out;
  out.globals = solved->step;
  out.covariance = solved->covariance;
  out.decrement = solved->decrement;
  out.solvable = true;
  out.scenes.resize(scenes.size());
  std::vector<SharedVariances> squares(scenes.size());
  std::vector<SharedVariances> determined(scenes.size());
  std::vector<SharedVariances> determined_squares(scenes.size());
  parallel_for(scenes.size(), how.threads, [&](std::size_t s) {
    if (!out.terms[s].usable) return;
    out.scenes[s] = parts[s].rest - parts[s].to_globals * out.globals;
    if (!how.measure_shared) return;
    const Eigen::Index n = out.scenes[s].size();
    const Eigen::MatrixXd inverse = parts[s].own.solve(Eigen::MatrixXd::Identity(n, n));
    const Eigen::MatrixXd spread = parts[s].to_globals * out.covariance;
    for (std::size_t k = 0; k < kSceneErrors; ++k) {
      if (!weighed(k)) continue;
      for (Eigen::Index i = 0; i < scenes[s].columns.count[k]; ++i) {
        const Eigen::Index at = kLocals + scenes[s].columns.first[k] + i;
        const double variance = inverse(at, at) + spread.row(at).dot(parts[s].to_globals.row(at));
        const double u = scenes[s].shared(scenes[s].columns.first[k] + i) + out.scenes[s](at);
        squares[s][k] += u * u;
        const double share = std::max(0.0, 1.0 - variance / variances[k]);
        determined[s][k] += share;
        determined_squares[s][k] += share * share;
      }
    }
  });
  SharedVariances second{};
  for (Eigen::Index i = 0; how.measure_shared && i < globals - kGlobals; ++i) {
    const std::size_t k = sensor_kind(i);
    const Eigen::Index at = kGlobals + i;
    const double u = prior.offset(at) + out.globals(at);
    const double share = std::max(0.0, 1.0 - out.covariance(at, at) / variances[k]);
    out.squares[k] += u * u;
    out.determined[k] += share;
    second[k] += share * share;
  }
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    for (std::size_t k = 0; k < kSharedErrors; ++k) {
      out.squares[k] += squares[s][k];
      out.determined[k] += determined[s][k];
      second[k] += determined_squares[s][k];
    }
  }
  for (std::size_t k = 0; k < kSharedErrors; ++k) {
    out.effective[k] = second[k] > 0.0 ? out.determined[k] * out.determined[k] / second[k] : 0.0;
  }
  return out;
}

}  // namespace lvcalib
