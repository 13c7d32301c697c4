// SPDX-License-Identifier: BSD-3-Clause
#include "solve/solution_report.h"

#include <algorithm>
#include <cmath>

#include "base/statistics.h"
#include "base/symmetric.h"
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

// Adds the residuals of a scene in use to those of all.
SceneSolution report_scene(const FeatureInput& in, const RobustFit& fit, std::size_t s,
                           std::vector<double>& all_px, std::vector<double>& all_mm) {
  const JointState& state = fit.fit.state;
  const Rigid3& board = state.camera_from_board[s];
  SceneSolution scene;
  scene.name = in.scenes[s].name;
  scene.used = fit.mask.scene[s];
  scene.reason = fit.reasons[s];
  scene.camera_from_board = board;
  scene.corners = corner_residuals(in.scenes[s], in.camera, board, fit.mask.corner[s]);
  scene.nodes = node_residuals(in.scenes[s], state.camera_from_lidar, board, fit.mask.node[s]);
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
  if (in.scenes[s].nodes.empty()) {
    mm = plane_heights_mm(in.scenes[s], in.target, state.camera_from_lidar, board);
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

void describe_uncertainty(const RobustFit& fit, double weak_ratio, ExtrinsicSolution& solution) {
  // Rotations act over the distance to the boards: scaled so, all six directions are lengths.
  std::vector<double> distances;
  for (std::size_t s = 0; s < fit.mask.scene.size(); ++s) {
    if (fit.mask.scene[s])
      distances.push_back(fit.fit.state.camera_from_board[s].translation.norm());
  }
  const double lever = std::max(0.1, median(std::move(distances)));
  Vector6d unit;
  unit << 1, 1, 1, 1 / lever, 1 / lever, 1 / lever;
  const Matrix6d scaled = unit.asDiagonal() * fit.fit.information * unit.asDiagonal();
  const auto axes = axes_of(scaled);
  const double largest = std::max(axes.values(5), 1e-300);
  const double weak = weak_ratio * weak_ratio;
  Matrix6d covariance = Matrix6d::Zero();
  solution.rank = 0;
  for (int k = 0; k < 6; ++k) {
    const double eigenvalue = axes.values(k);
    const Vector6d direction = axes.vectors.col(k);
    const bool determined = eigenvalue > 1e-10 * largest;
    if (determined) ++solution.rank;
    // An undetermined direction gets a visible, absurd standard deviation: a kilometre.
    const double variance = determined ? 1.0 / eigenvalue : 1e6;
    covariance += variance * direction * direction.transpose();
    const double middle = 0.5 * (axes.values(2) + axes.values(3));
    if (!determined || eigenvalue * weak < middle) {
      solution.weak_directions.push_back(describe_direction(
          direction, std::sqrt(middle / std::max(eigenvalue, 1e-300)), determined));
    }
  }
  solution.camera_from_lidar.covariance = unit.asDiagonal() * covariance * unit.asDiagonal();
}

std::vector<LeaveOneOut> leaving_out_each(const FeatureInput& in, const RobustFit& fit) {
  std::vector<LeaveOneOut> out;
  if (count_used(fit.mask) < fewest_to_leave_one_out(in.target)) return out;
  const JointState& state = fit.fit.state;
  for (std::size_t s = 0; s < in.scenes.size(); ++s) {
    if (!fit.mask.scene[s]) continue;
    ObservationMask without = fit.mask;
    without.scene[s] = false;
    const JointFit other = solve_joint(in, state, fit.scales, without);
    const Rigid3& a = state.camera_from_lidar;
    const Rigid3& b = other.state.camera_from_lidar;
    out.push_back({in.scenes[s].name, 1e3 * translation_distance_m(a.inverse(), b.inverse()),
                   1e3 * rotation_distance_rad(a, b)});
  }
  return out;
}

}  // namespace

ExtrinsicSolution report_solution(const RobustFit& fit, const FeatureInput& in,
                                  bool leave_one_out) {
  ExtrinsicSolution solution;
  solution.camera_from_lidar.transform = fit.fit.state.camera_from_lidar;
  solution.sigma_px = fit.scales.sigma_px;
  solution.node_scale = fit.scales.node;
  solution.plane_scale = fit.scales.plane;
  solution.used_scenes = count_used(fit.mask);
  describe_uncertainty(fit, in.options.weak_direction_ratio, solution);
  std::vector<double> all_px;
  std::vector<double> all_mm;
  for (std::size_t s = 0; s < in.scenes.size(); ++s)
    solution.scenes.push_back(report_scene(in, fit, s, all_px, all_mm));
  solution.rms_px = std::sqrt(2.0) * rms(all_px);
  solution.rms_mm = rms(all_mm);
  if (leave_one_out) solution.leave_one_out = leaving_out_each(in, fit);
  return solution;
}

}  // namespace lvcalib
