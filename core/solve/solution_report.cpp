// SPDX-License-Identifier: BSD-3-Clause
#include "solve/solution_report.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "base/statistics.h"
#include "solve/scene_residuals.h"

namespace lvcalib {
namespace {

Message describe_direction(const Vector6d& direction, double ratio, bool determined) {
  const Message names[] = {Message("translation along the camera's x axis"),
                           Message("translation along the camera's y axis"),
                           Message("translation along the camera's z axis"),
                           Message("rotation about the camera's x axis"),
                           Message("rotation about the camera's y axis"),
                           Message("rotation about the camera's z axis")};
  // Sideways moves and turns hide in each other at one distance; depth shows in tilted boards;
  // a turn about the view shows far from its middle.
  const Message advice[] = {
      Message("add a scene much nearer or farther, to part it from the turn about y"),
      Message("add a scene much nearer or farther, to part it from the turn about x"),
      Message("add a scene with the board nearer and tilted"),
      Message("add a scene much nearer or farther, or high or low in the image"),
      Message("add a scene much nearer or farther, or far left or right in the image"),
      Message("add a scene with the board near the image's edge")};
  Eigen::Index main = 0;
  direction.cwiseAbs().maxCoeff(&main);
  if (!determined)
    return Message("%1 is not determined: add scenes with the board turned differently",
                   names[main]);
  return Message("%1 is known %2 times worse than the typical direction: %3", names[main],
                 std::lround(ratio), advice[main]);
}

class SolutionReport {
 public:
  SolutionReport(const RobustFit& fit, const std::vector<SceneObservations>& scenes,
                 const Camera& camera, const Target& target, const ExtrinsicOptions& options)
      : fit_(fit), scenes_(scenes), camera_(camera), target_(target), options_(options) {}

  ExtrinsicSolution run(bool leaving_out) const {
    ExtrinsicSolution solution;
    solution.camera_from_lidar.transform = fit_.fit.state.camera_from_lidar;
    solution.sigma_px = fit_.scales.sigma_px;
    solution.node_scale = fit_.scales.node;
    solution.plane_scale = fit_.scales.plane;
    solution.iterations = fit_.fit.iterations;
    solution.used_scenes = count_used(fit_.mask);
    describe_uncertainty(solution);
    std::vector<double> all_px;
    std::vector<double> all_mm;
    for (std::size_t s = 0; s < scenes_.size(); ++s)
      solution.scenes.push_back(report_scene(s, all_px, all_mm));
    solution.rms_px = std::sqrt(2.0) * rms(all_px);
    solution.rms_mm = rms(all_mm);
    if (leaving_out) leave_one_out(solution);
    return solution;
  }

 private:
  SceneSolution report_scene(std::size_t s, std::vector<double>& all_px,
                             std::vector<double>& all_mm) const {
    const JointState& state = fit_.fit.state;
    const Rigid3& board = state.camera_from_board[s];
    SceneSolution scene;
    scene.name = scenes_[s].name;
    scene.used = fit_.mask.scene[s];
    scene.reason = fit_.reasons[s];
    scene.camera_from_board = board;
    scene.corners = corner_residuals(scenes_[s], camera_, board, fit_.mask.corner[s]);
    scene.nodes = node_residuals(scenes_[s], state.camera_from_lidar, board, fit_.mask.node[s]);
    std::vector<double> px;
    for (const CornerResidual& c : scene.corners) {
      if (!c.used) continue;
      px.push_back(c.residual_px.x());
      px.push_back(c.residual_px.y());
    }
    std::vector<double> mm;
    for (const NodeResidual& n : scene.nodes) {
      if (n.used) mm.push_back(1e3 * n.residual_m.norm());
    }
    if (scenes_[s].nodes.empty()) {
      mm = plane_heights_mm(scenes_[s], target_, state.camera_from_lidar, board);
    }
    // Distance per corner: two coordinates.
    scene.rms_px = std::sqrt(2.0) * rms(px);
    scene.rms_mm = rms(mm);
    if (scene.used) {
      all_px.insert(all_px.end(), px.begin(), px.end());
      all_mm.insert(all_mm.end(), mm.begin(), mm.end());
    }
    return scene;
  }

  void describe_uncertainty(ExtrinsicSolution& solution) const {
    // Rotations act over the distance to the boards: scaled so, all six directions are lengths.
    std::vector<double> distances;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      if (fit_.mask.scene[s])
        distances.push_back(fit_.fit.state.camera_from_board[s].translation.norm());
    }
    const double lever = std::max(0.1, median(std::move(distances)));
    Vector6d unit;
    unit << 1, 1, 1, 1 / lever, 1 / lever, 1 / lever;
    const Matrix6d scaled = unit.asDiagonal() * fit_.fit.information * unit.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Matrix6d> axes(scaled);
    const double largest = std::max(axes.eigenvalues()(5), 1e-300);
    const double weak = options_.weak_direction_ratio * options_.weak_direction_ratio;
    Matrix6d covariance = Matrix6d::Zero();
    solution.rank = 0;
    for (int k = 0; k < 6; ++k) {
      const double eigenvalue = axes.eigenvalues()(k);
      const Vector6d direction = axes.eigenvectors().col(k);
      const bool determined = eigenvalue > 1e-10 * largest;
      if (determined) ++solution.rank;
      // An undetermined direction gets a visible, absurd standard deviation: a kilometre.
      const double variance = determined ? 1.0 / eigenvalue : 1e6;
      covariance += variance * direction * direction.transpose();
      const double middle = 0.5 * (axes.eigenvalues()(2) + axes.eigenvalues()(3));
      if (!determined || eigenvalue * weak < middle) {
        solution.weak_directions.push_back(describe_direction(
            direction, std::sqrt(middle / std::max(eigenvalue, 1e-300)), determined));
      }
    }
    solution.camera_from_lidar.covariance = unit.asDiagonal() * covariance * unit.asDiagonal();
  }

  void leave_one_out(ExtrinsicSolution& solution) const {
    if (count_used(fit_.mask) < fewest_to_leave_one_out(target_)) return;
    const JointState& state = fit_.fit.state;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      if (!fit_.mask.scene[s]) continue;
      ObservationMask without = fit_.mask;
      without.scene[s] = false;
      const JointFit other =
          solve_joint(scenes_, camera_, target_, state, fit_.scales, without, options_);
      const Rigid3& a = state.camera_from_lidar;
      const Rigid3& b = other.state.camera_from_lidar;
      solution.leave_one_out.push_back({scenes_[s].name,
                                        1e3 * translation_distance_m(a.inverse(), b.inverse()),
                                        1e3 * rotation_distance_rad(a, b)});
    }
  }

  const RobustFit& fit_;
  const std::vector<SceneObservations>& scenes_;
  const Camera& camera_;
  const Target& target_;
  const ExtrinsicOptions& options_;
};

}  // namespace

ExtrinsicSolution report_solution(const RobustFit& fit,
                                  const std::vector<SceneObservations>& scenes,
                                  const Camera& camera, const Target& target,
                                  const ExtrinsicOptions& options, bool leave_one_out) {
  return SolutionReport(fit, scenes, camera, target, options).run(leave_one_out);
}

}  // namespace lvcalib
