// SPDX-License-Identifier: BSD-3-Clause
#include "solve/corner_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include "base/statistics.h"
#include "solve/cost_functions.h"

namespace lvcalib {
namespace {

constexpr double kPoseUnknowns = 6.0;

// One board pose from its corners; a scene whose solve fails keeps its start.
Rigid3 fit_pose(const SceneObservations& scene, const Camera& camera, const std::vector<bool>& mask,
                const Rigid3& start, double sigma_px, const ExtrinsicOptions& options) {
  std::array<double, 7> block{};
  rigid_to_block(start, block.data());
  RigidManifold manifold;
  ceres::HuberLoss loss(options.robust_threshold);
  ceres::Problem::Options ownership;
  ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddParameterBlock(block.data(), 7, &manifold);
  for (std::size_t k = 0; k < scene.corners.size(); ++k) {
    if (!mask[k]) continue;
    const CornerObservation& c = scene.corners[k];
    problem.AddResidualBlock(new CornerCost(camera, c.board_m, c.pixel, sigma_px), &loss,
                             block.data());
  }
  ceres::Solver::Options solver;
  solver.max_num_iterations = options.max_iterations;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.function_tolerance = 1e-12;
  solver.gradient_tolerance = 1e-12;
  solver.parameter_tolerance = 1e-12;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  return summary.IsSolutionUsable() ? rigid_from_block(block.data()) : start;
}

void append_errors(const SceneObservations& scene, const Camera& camera,
                   const std::vector<bool>& mask, const Rigid3& pose,
                   std::vector<Eigen::Vector2d>& errors) {
  for (std::size_t k = 0; k < scene.corners.size(); ++k) {
    if (!mask[k]) continue;
    const CornerObservation& c = scene.corners[k];
    const auto p = camera.project(pose * Eigen::Vector3d(c.board_m.x(), c.board_m.y(), 0.0));
    if (p) errors.emplace_back(c.pixel - *p);
  }
}

// Huber's weights over corners, as in the joint objective: w = min(1, threshold/|e|).
double robust_sigma_px(const std::vector<Eigen::Vector2d>& errors, double unknowns, double sigma_px,
                       double threshold) {
  double sum = 0.0;
  for (const Eigen::Vector2d& e : errors) {
    const double size = e.norm() / sigma_px;
    sum += e.squaredNorm() * (size > threshold ? threshold / size : 1.0);
  }
  const double redundancy = 2.0 * static_cast<double>(errors.size()) - unknowns;
  return redundancy > 1.0 ? std::sqrt(sum / redundancy) : sigma_px;
}

}  // namespace

CornerFit fit_corners(const FeatureInput& in, const ObservationMask& mask) {
  const std::vector<SceneObservations>& scenes = in.scenes;
  const ExtrinsicOptions& options = in.options;
  constexpr int kRounds = 8;
  CornerFit fit;
  for (const SceneObservations& scene : scenes)
    fit.camera_from_board.push_back(scene.camera_from_board);
  const auto used = static_cast<double>(std::count(mask.scene.begin(), mask.scene.end(), true));
  const auto errors_now = [&] {
    std::vector<Eigen::Vector2d> errors;
    for (std::size_t s = 0; s < scenes.size(); ++s) {
      if (mask.scene[s])
        append_errors(scenes[s], in.camera, mask.corner[s], fit.camera_from_board[s], errors);
    }
    return errors;
  };
  std::vector<double> components;
  for (const Eigen::Vector2d& e : errors_now()) components.insert(components.end(), {e.x(), e.y()});
  if (components.empty()) {
    fit.sigma_px = options.sigma_px_floor;
    return fit;
  }
  fit.sigma_px = std::max(options.sigma_px_floor, mad_sigma(std::move(components)));
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t s = 0; s < scenes.size(); ++s) {
      if (!mask.scene[s]) continue;
      fit.camera_from_board[s] = fit_pose(scenes[s], in.camera, mask.corner[s],
                                          fit.camera_from_board[s], fit.sigma_px, options);
    }
    const double before = fit.sigma_px;
    fit.sigma_px = std::max(
        options.sigma_px_floor,
        robust_sigma_px(errors_now(), kPoseUnknowns * used, before, options.robust_threshold));
    if (std::abs(std::log(fit.sigma_px / before)) < 0.01) break;
  }
  return fit;
}

}  // namespace lvcalib
