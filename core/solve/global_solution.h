// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "solve/forward_problem.h"

namespace lvcalib {

/// What is known of globals beforehand: standard deviation 0 holds one where it is.
struct GlobalPrior {
  Eigen::VectorXd sigma = Eigen::VectorXd::Zero(kGlobals);
  /// Deviation of the present value from the prior's mean.
  Eigen::VectorXd offset = Eigen::VectorXd::Zero(kGlobals);
  /// Appends the sensor's errors, whose prior is their variance.
  void set_sensor(const SensorErrors& sensor, const SharedVariances& variances);
  /// What else is known of the intrinsics, with its correlations: information, and its gradient at
  /// the present value. Of intrinsics that are held it is not used, but kept for asking what
  /// freeing them would do.
  Eigen::Matrix<double, kIntrinsics, kIntrinsics> evidence =
      Eigen::Matrix<double, kIntrinsics, kIntrinsics>::Zero();
  Eigen::Matrix<double, kIntrinsics, 1> evidence_gradient =
      Eigen::Matrix<double, kIntrinsics, 1>::Zero();
};

/// What one scene says about the globals once its own unknowns are eliminated.
struct GlobalTerm {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;
  /// What the gradient scatters beyond `information`, because whole boards move.
  Eigen::MatrixXd spread;
  bool usable = false;
};

/// Solution of the normal equations of all scenes.
struct GlobalSolution {
  std::vector<GlobalTerm> terms;  ///< Per scene.
  Eigen::VectorXd globals;
  Eigen::MatrixXd covariance;           ///< Of the globals.
  std::vector<Eigen::VectorXd> scenes;  ///< Locals and shared errors of every scene.
  SharedVariances squares{};            ///< Σu² of the shared errors after the step, per kind,
  SharedVariances determined{};         ///< how many of them the data determine,
  SharedVariances effective{};          ///< and how many count, if some are known far better.
  double decrement = 0.0;               ///< xᵀNx of the globals' step: its size in σ, squared.
  bool solvable = false;
};

/// Where motions of boards are not weighed (see moves_board()) they widen the covariance instead.
enum class BoardMotion { kWeighed, kWidens };

struct EliminationOptions {
  BoardMotion motion = BoardMotion::kWidens;
  /// Also measure what the variances of the kinds that are weighed should be.
  bool measure_shared = false;
  int threads = 1;
};

/// Eliminates the scenes (Schur complement) and solves. Priors of locals are in the equations,
/// those of the sensor's errors follow from the variances.
GlobalSolution solve_equations(const std::vector<SceneEquations>& scenes, GlobalPrior prior,
                               const SensorErrors& sensor, const SharedVariances& variances,
                               const EliminationOptions& how);

/// What one scene says about faults that the solve does not have (see kFaults), its own unknowns
/// eliminated.
struct FaultTerm {
  Eigen::Matrix<double, Eigen::Dynamic, kFaults> coupling;  ///< By the globals.
  FaultMatrix information = FaultMatrix::Zero();
  FaultRow gradient = FaultRow::Zero();
};

/// Zero where the scene's equations cannot be solved for its own unknowns.
FaultTerm fault_term(const SceneEquations& scene, const SharedVariances& variances,
                     BoardMotion motion);

/// The globals' step and its covariance from some scenes' terms. Nothing if they do not determine
/// the extrinsic.
struct GlobalStep {
  Eigen::VectorXd step;
  Eigen::MatrixXd covariance;
  double decrement = 0.0;
};
std::optional<GlobalStep> solve_terms(const std::vector<const GlobalTerm*>& terms,
                                      const GlobalPrior& prior);

}  // namespace lvcalib
