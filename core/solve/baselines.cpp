// SPDX-License-Identifier: BSD-3-Clause
#include "solve/baselines.h"

#include <algorithm>
#include <cmath>

#include <ceres/problem.h>
#include <ceres/solver.h>

#include "base/symmetric.h"
#include "solve/alignment.h"
#include "solve/cost_functions.h"

namespace lvcalib {
namespace {

Eigen::Vector3d on_board(const Eigen::Vector2d& p) {
  return {p.x(), p.y(), 0.0};
}

// Calls work(scene index, node) for every node that takes part.
template <class F>
void for_each_node(const MethodInput& input, F&& work) {
  for (std::size_t s = 0; s < input.scenes.size(); ++s) {
    if (!input.mask.scene[s]) continue;
    for (std::size_t k = 0; k < input.scenes[s].nodes.size(); ++k) {
      if (input.mask.node[s][k]) work(s, input.scenes[s].nodes[k]);
    }
  }
}

// Covariance of the board pose that the corners alone give.
Matrix6d pose_covariance(const MethodInput& input, std::size_t s) {
  Matrix6d information = Matrix6d::Zero();
  for (std::size_t k = 0; k < input.scenes[s].corners.size(); ++k) {
    if (!input.mask.corner[s][k]) continue;
    const Eigen::Vector3d p =
        input.camera_from_board[s] * on_board(input.scenes[s].corners[k].board_m);
    Eigen::Matrix<double, 2, 3> by_point;
    if (!input.camera.project(p, &by_point)) continue;
    const Eigen::Matrix<double, 2, 6> j = by_point * point_by_pose(p);
    information += j.transpose() * j;
  }
  return input.scales.sigma_px * input.scales.sigma_px * symmetric_inverse(information);
}

double lidar_variance(const MethodInput& input, std::size_t s, const RefinedNode& node) {
  const double in_plane = input.scales.node * input.scales.node * node.covariance_m2.trace() +
                          2.0 * input.options.node_sigma_floor_m * input.options.node_sigma_floor_m;
  return in_plane +
         input.scales.plane * input.scales.plane * input.scenes[s].plane.covariance(0, 0);
}

}  // namespace

Rigid3 solve_by_alignment(const MethodInput& input, bool weighted) {
  std::vector<Matrix6d> covariance(input.scenes.size(), Matrix6d::Zero());
  for (std::size_t s = 0; weighted && s < input.scenes.size(); ++s) {
    if (input.mask.scene[s]) covariance[s] = pose_covariance(input, s);
  }
  std::vector<PointPair> pairs;
  for_each_node(input, [&](std::size_t s, const RefinedNode& node) {
    PointPair pair{input.camera_from_board[s] * on_board(node.board_m), node.center_lidar_m, 1.0};
    if (weighted) {
      const Eigen::Matrix<double, 3, 6> j = point_by_pose(pair.target_m);
      pair.weight =
          1.0 / ((j * covariance[s] * j.transpose()).trace() + lidar_variance(input, s, node));
    }
    pairs.push_back(pair);
  });
  return align_points(pairs);
}

Rigid3 solve_by_reprojection(const MethodInput& input) {
  std::array<double, 7> block{};
  rigid_to_block(solve_by_alignment(input, false), block.data());
  RigidManifold manifold;
  ceres::Problem::Options problem_options;
  problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(problem_options);
  problem.AddParameterBlock(block.data(), 7, &manifold);
  for_each_node(input, [&](std::size_t s, const RefinedNode& node) {
    const auto pixel = input.camera.project(input.camera_from_board[s] * on_board(node.board_m));
    if (!pixel) return;
    problem.AddResidualBlock(new CornerCost(input.camera, node.center_lidar_m, *pixel, 1.0),
                             nullptr, block.data());
  });
  ceres::Solver::Options options;
  options.max_num_iterations = input.options.max_iterations;
  options.linear_solver_type = ceres::DENSE_QR;
  options.function_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return rigid_from_block(block.data());
}

Rigid3 solve_by_joint(const MethodInput& input, const Rigid3& start) {
  constexpr int kRounds = 5;
  NoiseScales scales = input.scales;
  JointState state{start, input.camera_from_board};
  for (int round = 0; round < kRounds; ++round) {
    const JointFit fit = solve_joint(input, state, scales, input.mask);
    state = fit.state;
    const GroupFit& nodes = fit.groups[static_cast<std::size_t>(ResidualGroup::kNode)];
    if (nodes.redundancy < 1.0) break;
    const double wanted =
        std::max(1.0, scales.node * std::sqrt(nodes.chi_square / nodes.redundancy));
    const bool still = std::abs(std::log(wanted / scales.node)) < 0.05;
    scales.node = wanted;
    if (still) break;
  }
  return state.camera_from_lidar;
}

Rigid3 solve_as_stated(const MethodInput& input, const Rigid3& start) {
  return solve_joint(input, {start, input.camera_from_board}, input.scales, input.mask)
      .state.camera_from_lidar;
}

std::vector<SceneObservations> with_raw_nodes(std::vector<SceneObservations> scenes) {
  for (SceneObservations& scene : scenes) {
    for (RefinedNode& node : scene.nodes) {
      node.center_lidar_m = node.raw_lidar_m;
      node.center_uv_m = scene.plane.to_plane(node.raw_lidar_m);
    }
  }
  return scenes;
}

}  // namespace lvcalib
