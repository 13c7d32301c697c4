// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/forward_stage.h"

#include <algorithm>

#include <Eigen/Cholesky>

#include "extrinsic/solution_report.h"

namespace lvcalib {

std::vector<ForwardScene> forward_scenes(const CalibrationResult& result,
                                         const std::vector<SceneObservations>& observations,
                                         const std::vector<std::size_t>& index,
                                         const ExtrinsicSolution& start) {
  std::vector<ForwardScene> scenes;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const SceneSolution& solved = start.scenes[k];
    if (!solved.used) continue;
    const SceneObservations& from = observations[k];
    ForwardScene scene;
    scene.name = from.name;
    for (std::size_t i = 0; i < from.corners.size(); ++i) {
      if (solved.corners[i].used) scene.corners.push_back(from.corners[i]);
    }
    scene.board_points = &result.scenes[index[k]].board_points;
    scene.camera_from_board = solved.camera_from_board;
    scene.lidar_from_board = from.lidar_from_board;
    const auto& sigma = from.plane.group_sigma_m;
    scene.range_sigma_m = std::max({1e-4, sigma[0], sigma[1]});
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

Result<ForwardSolution> solve_every_return(const CalibrationResult& result,
                                           const std::vector<SceneObservations>& observations,
                                           const std::vector<std::size_t>& index,
                                           const ExtrinsicSolution& start,
                                           const ForwardOptions& options,
                                           const RunContext& context) {
  return solve_forward(forward_scenes(result, observations, index, start), *result.print,
                       result.intrinsics.given, start.camera_from_lidar.transform, start.sigma_px,
                       options, context);
}

ExtrinsicSolution report_forward(const ForwardSolution& forward, const ExtrinsicSolution& start,
                                 const std::vector<SceneObservations>& observations,
                                 const Camera& camera, const Target& target,
                                 const ExtrinsicOptions& options) {
  RobustFit fit;
  fit.mask = mask_of(start);
  fit.scales = scales_of(start);
  fit.fit.iterations = forward.iterations;
  fit.fit.converged = forward.converged;
  fit.fit.state.camera_from_lidar = forward.state.camera_from_lidar;
  fit.fit.information = forward.camera_from_lidar.covariance.ldlt().solve(Matrix6d::Identity());
  std::size_t next = 0;
  for (const SceneSolution& scene : start.scenes) {
    fit.reasons.push_back(scene.reason);
    fit.fit.state.camera_from_board.push_back(scene.used ? forward.state.camera_from_board[next++]
                                                         : scene.camera_from_board);
  }
  ExtrinsicSolution solution = report_solution(fit, observations, camera, target, options, false);
  const SubsetSolver subset = forward_subsets(forward, start);
  const Rigid3& all = forward.state.camera_from_lidar;
  const int fewest = forward.uses_intensity ? 2 : fewest_to_leave_one_out(target);
  for (std::size_t k = 0; solution.used_scenes >= fewest && k < start.scenes.size(); ++k) {
    if (!start.scenes[k].used) continue;
    std::vector<std::size_t> rest;
    for (std::size_t i = 0; i < start.scenes.size(); ++i) {
      if (i != k && start.scenes[i].used) rest.push_back(i);
    }
    const auto other = subset(rest);
    if (!other) continue;
    solution.leave_one_out.push_back(
        {start.scenes[k].name,
         1e3 * translation_distance_m(all.inverse(), other->transform.inverse()),
         1e3 * rotation_distance_rad(all, other->transform)});
  }
  return solution;
}

SubsetSolver forward_subsets(const ForwardSolution& forward, const ExtrinsicSolution& start) {
  std::vector<std::size_t> place(start.scenes.size(), 0);
  std::size_t next = 0;
  for (std::size_t k = 0; k < start.scenes.size(); ++k) {
    if (start.scenes[k].used) place[k] = next++;
  }
  return [&forward, place](const std::vector<std::size_t>& scenes) {
    std::vector<bool> use(forward.terms.size(), false);
    for (const std::size_t k : scenes) use[place[k]] = true;
    return solve_subset(forward, use);
  };
}

}  // namespace lvcalib
