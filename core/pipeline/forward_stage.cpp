// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/forward_stage.h"

#include <algorithm>

#include "base/normal_equations.h"
#include "base/symmetric.h"
#include "solve/solution_report.h"

namespace lvcalib {

std::vector<SceneObservations> observations_of(const CalibrationResult& result,
                                               const std::vector<bool>& use,
                                               std::vector<std::size_t>& index) {
  std::vector<SceneObservations> observations;
  for (std::size_t s = 0; s < result.scenes.size(); ++s) {
    const SceneResult& scene = result.scenes[s];
    if (!scene.view || !scene.refinement) continue;
    SceneObservations o;
    o.name = scene.name;
    o.use = s < use.size() && use[s];
    o.corners = scene.view->corners;
    o.camera_from_board = scene.view->camera_from_board.transform;
    // Of an ambiguous camera pose take the reading that the LiDAR supports.
    if (scene.view->alternative_pose) {
      const Rigid3 predicted =
          result.consensus.camera_from_lidar.transform * scene.refinement->lidar_from_board;
      if (rotation_distance_rad(*scene.view->alternative_pose, predicted) <
          rotation_distance_rad(o.camera_from_board, predicted)) {
        o.camera_from_board = *scene.view->alternative_pose;
      }
    }
    o.plane = scene.refinement->plane;
    o.lidar_from_board = scene.refinement->lidar_from_board;
    o.nodes = scene.refinement->nodes;
    observations.push_back(std::move(o));
    index.push_back(s);
  }
  return observations;
}

Target target_in_use(const CalibrationResult& result,
                     const std::vector<SceneObservations>& observations) {
  Target target = result.target;
  const bool nodes =
      std::any_of(observations.begin(), observations.end(),
                  [](const SceneObservations& o) { return o.use && !o.nodes.empty(); });
  if (target.has_circles() && !nodes) target.type = TargetType::kAprilGrid;
  return target;
}

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
    for (std::size_t i = 0; i < from.corners.size(); ++i) {
      if (solved.corners[i].used) scene.corners.push_back(from.corners[i]);
    }
    scene.board_points = &result.scenes[index[k]].board_points;
    scene.uncovered = result.scenes[index[k]].edits.kept_patches;
    scene.camera_from_board = solved.camera_from_board;
    scene.lidar_from_board = from.lidar_from_board;
    const auto& sigma = from.plane.group_sigma_m;
    scene.range_sigma_m = std::max({1e-4, sigma[0], sigma[1]});
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

namespace {

// Where the joint solve starts. Planes alone may leave the LiDAR's position open by decimetres,
// which the localized boards hold to some millimetres; measured circles know it better than those.
Rigid3 start_pose(const SceneConsensus& consensus, const ExtrinsicSolution& features) {
  if (!(consensus.camera_from_lidar.covariance.diagonal().minCoeff() > 0.0))
    return features.camera_from_lidar.transform;
  return information_mean({features.camera_from_lidar, consensus.camera_from_lidar}).transform;
}

}  // namespace

Result<ForwardSolution> solve_every_return(const CalibrationResult& result,
                                           const std::vector<SceneObservations>& observations,
                                           const std::vector<std::size_t>& index,
                                           const ExtrinsicSolution& start,
                                           const ForwardOptions& options,
                                           const RunContext& context) {
  // Intrinsics are drawn to the given ones; those of another model to where they start.
  const Camera& given = result.intrinsics.given;
  const bool other = options.first_camera && options.first_camera->model != given.model;
  return solve_forward(
      {forward_scenes(result, observations, index, start), *result.print,
       other ? *options.first_camera : given, start_pose(result.consensus, start), start.sigma_px},
      options, context);
}

ReportedPose pose_of(const ForwardSolution& forward) {
  return {{forward.state.camera_from_lidar, forward.camera_from_lidar.covariance},
          forward.state.camera_from_board,
          forward.uses_intensity};
}

ProjectionCovariance projection_covariance(const CalibrationResult& result,
                                           const Matrix6d& extrinsic) {
  ProjectionCovariance out = ProjectionCovariance::held(extrinsic);
  if (!result.forward || !result.model.empty()) return out;
  const Eigen::MatrixXd& globals = result.forward->globals_covariance;
  if (globals.rows() < kGlobals) return out;
  out.cross = globals.block<kIntrinsics, 6>(kFirstIntrinsic, 0);
  out.intrinsics = globals.block<kIntrinsics, kIntrinsics>(kFirstIntrinsic, kFirstIntrinsic);
  return out;
}

ExtrinsicSolution report_forward(const ReportedPose& pose, const SubsetSolver& subset,
                                 const ExtrinsicSolution& start, const FeatureInput& in) {
  const Rigid3& all = pose.camera_from_lidar.transform;
  RobustFit fit;
  fit.mask = mask_of(start);
  fit.scales = scales_of(start);
  fit.fit.state.camera_from_lidar = all;
  fit.fit.information = symmetric_inverse(pose.camera_from_lidar.covariance);
  std::size_t next = 0;
  for (const SceneSolution& scene : start.scenes) {
    fit.reasons.push_back(scene.reason);
    fit.fit.state.camera_from_board.push_back(scene.used ? pose.camera_from_board[next++]
                                                         : scene.camera_from_board);
  }
  ExtrinsicSolution solution = report_solution(fit, in, false);
  const int fewest = pose.uses_intensity ? 2 : fewest_to_leave_one_out(in.target);
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

namespace {

// Where the observations in use stand among the scenes of a joint solve.
std::vector<std::size_t> places_in_use(const ExtrinsicSolution& start) {
  std::vector<std::size_t> place(start.scenes.size(), 0);
  std::size_t next = 0;
  for (std::size_t k = 0; k < start.scenes.size(); ++k) {
    if (start.scenes[k].used) place[k] = next++;
  }
  return place;
}

}  // namespace

SubsetSolver forward_subsets(const ForwardSolution& forward, const ExtrinsicSolution& start) {
  return [&forward, place = places_in_use(start)](const std::vector<std::size_t>& scenes) {
    std::vector<bool> use(forward.terms.size(), false);
    for (const std::size_t k : scenes) use[place[k]] = true;
    return solve_subset(forward, use);
  };
}

SubsetSolver model_subsets(const std::shared_ptr<const ModelFit>& fit,
                           const Rigid3& camera_from_lidar, const ExtrinsicSolution& start) {
  return [fit, camera_from_lidar, place = places_in_use(start)](
             const std::vector<std::size_t>& scenes) -> std::optional<UncertainRigid3> {
    if (!fit) return std::nullopt;
    Eigen::MatrixXd information = fit->prior.information;
    Eigen::VectorXd gradient = fit->prior.gradient;
    Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(information.rows(), information.cols());
    for (const std::size_t k : scenes) {
      if (place[k] >= fit->scenes.size()) return std::nullopt;
      information += fit->scenes[place[k]].information;
      gradient += fit->scenes[place[k]].gradient;
      if (fit->scenes[place[k]].spread.size() > 0) spread += fit->scenes[place[k]].spread;
    }
    const auto solved = solve_normal_equations(information, gradient);
    if (!solved) return std::nullopt;
    const Vector6d move = solved->x.head<6>() - fit->solution.head<6>();
    const Eigen::MatrixXd& inverse = solved->covariance;
    const Eigen::MatrixXd covariance = inverse + inverse * spread * inverse;
    return UncertainRigid3{se3_exp(move) * camera_from_lidar, covariance.topLeftCorner<6, 6>()};
  };
}

}  // namespace lvcalib
