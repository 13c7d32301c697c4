// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Simulated rigs for tests of the joint solve: clouds by the simulator, corners by projection of
// the truth with noise, so that no image need be searched.

#include <deque>
#include <vector>

#include "solve/forward_solver.h"
#include "support/simulated_boards.h"

namespace lvcalib::test {

struct ForwardRig {
  Target target;
  Camera camera;
  Rigid3 camera_from_lidar;
  std::deque<Cloud> clouds;  ///< Points about the boards; scenes point into it.
  std::vector<ForwardScene> scenes;
  std::vector<Rigid3> lidar_from_board;

  /// The rig with its extrinsic known to `off` (left perturbation) only.
  [[nodiscard]] Rigid3 start(const Vector6d& off) const { return se3_exp(off) * camera_from_lidar; }
};

inline constexpr double kRigCornerSigma_px = 0.03;

inline ForwardRig forward_rig(const simulation::SimulationOptions& options) {
  ForwardRig rig;
  const auto simulator = simulation::Simulator::create(options);
  if (!simulator) {
    ADD_FAILURE() << simulator.error().text();
    return rig;
  }
  rig.target = simulator->rig().target;
  rig.camera = simulator->rig().camera;
  // The simulated picture is small; the corners are those of a camera with four times its pixels.
  rig.camera.width_px *= 4;
  rig.camera.height_px *= 4;
  rig.camera.fx *= 4;
  rig.camera.fy *= 4;
  rig.camera.cx = 4 * rig.camera.cx + 1.5;
  rig.camera.cy = 4 * rig.camera.cy + 1.5;
  rig.camera_from_lidar = simulator->rig().camera_from_lidar;
  Random random(options.seed + 77);
  for (int s = 0; s < options.scenes; ++s) {
    const auto scene = simulator->simulate_scene(s, {});
    if (!scene) {
      ADD_FAILURE() << scene.error().text();
      return rig;
    }
    rig.clouds.push_back(points_about(scene->cloud, rig.target, scene->lidar_from_board));
    ForwardScene forward;
    forward.board_points = &rig.clouds.back();
    forward.camera_from_board = rig.camera_from_lidar * scene->lidar_from_board;
    forward.lidar_from_board = scene->lidar_from_board;
    const auto add = [&](int feature, int corner, const Eigen::Vector2d& at) {
      const auto pixel =
          rig.camera.project(forward.camera_from_board * Eigen::Vector3d(at.x(), at.y(), 0.0));
      if (!pixel || !rig.camera.in_image(*pixel)) return;
      Eigen::Vector2d noise;
      for (double& part : noise) part = random.normal();
      forward.corners.push_back({feature, corner, at, *pixel + kRigCornerSigma_px * noise, 0.0});
    };
    for (const TargetTag& tag :
         rig.target.has_tags() ? rig.target.tags() : std::vector<TargetTag>{}) {
      const auto corners = rig.target.tag_corners_m(tag);
      for (std::size_t k = 0; k < corners.size(); ++k) add(tag.id, static_cast<int>(k), corners[k]);
    }
    int index = 0;
    if (!rig.target.has_tags()) {
      for (const Eigen::Vector2d& p : rig.target.checkerboard_corners_m()) add(index++, 0, p);
    }
    rig.lidar_from_board.push_back(scene->lidar_from_board);
    rig.scenes.push_back(std::move(forward));
  }
  return rig;
}

inline Result<ForwardSolution> solve(const ForwardRig& rig, const Vector6d& off,
                                     const RunContext& context = {}) {
  const BlurredPrint print(rig.target);
  return solve_forward({rig.scenes, print, rig.camera, rig.start(off), kRigCornerSigma_px}, {},
                       context);
}

/// Error of a solution, in standard deviations, per component.
inline Vector6d in_sigmas(const UncertainRigid3& solution, const Rigid3& truth) {
  const Vector6d e = se3_log(truth * solution.transform.inverse());
  return e.cwiseQuotient(solution.covariance.diagonal().cwiseSqrt());
}

/// √(eᵀΣ⁻¹e/6): about one if the stated covariance holds.
inline double size_in_sigmas(const UncertainRigid3& solution, const Rigid3& truth) {
  const Vector6d e = se3_log(truth * solution.transform.inverse());
  return std::sqrt(e.dot(solution.covariance.ldlt().solve(e)) / 6.0);
}

}  // namespace lvcalib::test
