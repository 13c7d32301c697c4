// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/feature_problem.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "support/pose_matchers.h"
#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

struct Problem {
  Target target;
  Camera camera = test::test_camera();
  Rigid3 truth = test::test_extrinsic();
  std::vector<SceneObservations> scenes;
  ObservationMask mask;
  JointState start;
  NoiseScales scales;
  ExtrinsicOptions options;

  Problem(int count, const test::ObservationNoise& noise, std::uint64_t seed) {
    scenes = test::observed_scenes(count, target, camera, truth, noise, seed);
    for (const SceneObservations& scene : scenes) {
      mask.scene.push_back(true);
      mask.corner.emplace_back(scene.corners.size(), true);
      mask.node.emplace_back(scene.nodes.size(), true);
      start.camera_from_board.push_back(scene.camera_from_board);
    }
    Random random(seed, 7);
    start.camera_from_lidar = test::disturbed(truth, random, 0.03, 0.03);
    scales.sigma_px = noise.corner_px;
  }
  [[nodiscard]] JointFit solve() const {
    return solve_joint({scenes, camera, target, options}, start, scales, mask);
  }
};

constexpr test::ObservationNoise kNoiseFree{0.0, 0.0, 0.0, 0.0};

TEST(JointProblem, FindsTheTruthFromNoiseFreeObservations) {
  Problem setup(3, kNoiseFree, 1);
  setup.scales.sigma_px = 0.1;
  const JointFit fit = setup.solve();
  EXPECT_TRUE(fit.converged);
  EXPECT_THAT(fit.state.camera_from_lidar, test::IsNearPose(setup.truth, 1e-5, 1e-5));
  for (int s = 0; s < 3; ++s) {
    EXPECT_THAT(fit.state.camera_from_board[static_cast<std::size_t>(s)],
                test::IsNearPose(test::spread_board(setup.target, s), 1e-5, 1e-5));
  }
}

TEST(JointProblem, RedundanciesAddUpToObservationsMinusUnknowns) {
  const Problem setup(3, {}, 2);
  const JointFit fit = setup.solve();
  ASSERT_TRUE(fit.converged);
  double redundancy = 0.0;
  int count = 0;
  for (const GroupFit& group : fit.groups) {
    redundancy += group.redundancy;
    count += group.count;
    EXPECT_GE(group.redundancy, 0.0);
    EXPECT_LE(group.redundancy, group.count);
  }
  EXPECT_EQ(count, 3 * (2 * 64 + 2 * 9 + 3));
  EXPECT_NEAR(redundancy, count - 6 * (1 + 3), 1e-3);
  // The scales are the true ones: every group's χ² is about its redundancy.
  for (const GroupFit& group : fit.groups) {
    EXPECT_NEAR(group.chi_square, group.redundancy, 4.0 * std::sqrt(2.0 * group.redundancy) + 1.0);
  }
}

TEST(JointProblem, InformationFollowsTheStatedNoise) {
  Problem setup(3, {}, 3);
  setup.options.node_sigma_floor_m = 0.0;
  setup.options.plane_sigma_floor_m = 1e-9;
  const Matrix6d information = setup.solve().information;
  setup.scales.sigma_px *= 2.0;
  setup.scales.node *= 2.0;
  setup.scales.plane *= 2.0;
  const Matrix6d quarter = setup.solve().information;
  EXPECT_LT((4.0 * quarter - information).norm(), 0.01 * information.norm());
  // More observations, more information.
  setup.mask.scene[2] = false;
  const Matrix6d less = setup.solve().information;
  const Eigen::LLT<Matrix6d> gain(Matrix6d(quarter - less));
  EXPECT_EQ(gain.info(), Eigen::Success);
}

TEST(JointProblem, WhatTheMaskHidesTakesNoPart) {
  Problem setup(3, {}, 4);
  const JointFit clean = setup.solve();
  Problem spoilt(3, {}, 4);
  spoilt.scenes[0].corners[5].pixel += Eigen::Vector2d(40, -30);
  spoilt.scenes[1].nodes[2].center_lidar_m += Eigen::Vector3d(0.1, 0.2, 0.1);
  spoilt.mask.corner[0][5] = false;
  spoilt.mask.node[1][2] = false;
  setup.mask = spoilt.mask;
  const JointFit without = setup.solve();
  const JointFit hidden = spoilt.solve();
  EXPECT_EQ(hidden.state.camera_from_lidar.matrix(), without.state.camera_from_lidar.matrix());
  EXPECT_EQ(hidden.groups[0].count, clean.groups[0].count - 2);
  EXPECT_EQ(hidden.groups[1].count, clean.groups[1].count - 2);
  // A hidden scene keeps its start pose.
  spoilt.mask.scene[1] = false;
  const JointFit two = spoilt.solve();
  EXPECT_EQ(two.state.camera_from_board[1].matrix(), spoilt.start.camera_from_board[1].matrix());
  EXPECT_NE(two.state.camera_from_board[0].matrix(), spoilt.start.camera_from_board[0].matrix());
}

TEST(JointProblem, NodesOnAllAxesStandForThePlane) {
  for (const NodeTerm term : {NodeTerm::kAllAxes, NodeTerm::kIsotropic}) {
    Problem setup(3, kNoiseFree, 1);
    setup.scales.sigma_px = 0.1;
    setup.options.node_term = term;
    const JointFit fit = setup.solve();
    EXPECT_THAT(fit.state.camera_from_lidar, test::IsNearPose(setup.truth, 1e-5, 1e-5));
    EXPECT_EQ(fit.groups[1].count, 3 * 3 * 9);
    EXPECT_EQ(fit.groups[2].count, 0);
  }
}

// A centre known well along one axis alone: one deviation cannot say so, the covariance does.
TEST(JointProblem, OneDeviationForgetsWhichWayACentreIsUncertain) {
  Problem setup(2, kNoiseFree, 6);
  setup.scales.sigma_px = 0.1;
  SceneObservations& scene = setup.scenes[0];
  for (RefinedNode& node : scene.nodes) {
    node.covariance_m2 = Eigen::Vector2d(1e-4, 1e-8).asDiagonal();
    node.center_lidar_m += 0.01 * scene.plane.axis_u;  // One σ off where it is uncertain.
  }
  const auto off = [&](NodeTerm term) {
    setup.options.node_term = term;
    return translation_distance_m(setup.solve().state.camera_from_lidar, setup.truth);
  };
  EXPECT_GT(off(NodeTerm::kIsotropic), 1.5 * off(NodeTerm::kAllAxes));
}

TEST(JointProblem, ABoardBehindTheCameraIsNotConverged) {
  Problem setup(2, {}, 5);
  setup.start.camera_from_board[0].translation.z() = -3.0;
  EXPECT_FALSE(setup.solve().converged);
}

TEST(Whitening, GivesUnitCovariance) {
  Eigen::Matrix2d c2;
  c2 << 4e-6, 1e-6, 1e-6, 2e-6;
  EXPECT_LT(
      (whitening_2(c2) * c2 * whitening_2(c2).transpose() - Eigen::Matrix2d::Identity()).norm(),
      1e-9);
  Eigen::Matrix3d c3;
  c3 << 4, 1, 0.5, 1, 3, -0.4, 0.5, -0.4, 2;
  EXPECT_LT(
      (whitening_3(c3) * c3 * whitening_3(c3).transpose() - Eigen::Matrix3d::Identity()).norm(),
      1e-12);
}

TEST(PlaneProbes, LieOnTheOutlineAndAreNotInLine) {
  Target target;
  target.tag_columns = 6;
  const Eigen::Matrix3d probes = plane_probe_points(target);
  const BoardOutline outline = target.outline();
  for (int k = 0; k < 3; ++k) {
    EXPECT_GE(probes(0, k), outline.lower_left_m.x() - 1e-12);
    EXPECT_LE(probes(0, k), outline.upper_right_m.x() + 1e-12);
    EXPECT_GE(probes(1, k), outline.lower_left_m.y() - 1e-12);
    EXPECT_LE(probes(1, k), outline.upper_right_m.y() + 1e-12);
    EXPECT_EQ(probes(2, k), 0.0);
  }
  const Eigen::Vector3d a = probes.col(1) - probes.col(0);
  const Eigen::Vector3d b = probes.col(2) - probes.col(0);
  EXPECT_GT(a.cross(b).norm(), 0.5 * outline.size_m().prod());
}

TEST(PlaneProbes, CovarianceIsThatOfTheHeights) {
  const Target target;
  const Rigid3 lidar_from_board = test::test_extrinsic().inverse() * test::spread_board(target, 1);
  const Eigen::Matrix3d probes = plane_probe_points(target);
  const test::ObservationNoise noise;
  Random random(9);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  constexpr int kDraws = 20'000;
  FittedPlane plane;
  for (int i = 0; i < kDraws; ++i) {
    plane = test::observed_plane(target, lidar_from_board, noise, random);
    Eigen::Vector3d height;
    for (int k = 0; k < 3; ++k) {
      height(k) =
          plane.normal.dot(lidar_from_board * Eigen::Vector3d(probes.col(k)) - plane.center_m);
    }
    sum += height * height.transpose() / kDraws;
  }
  const Eigen::Matrix3d stated = probe_covariance(plane, lidar_from_board, probes, 0.0);
  EXPECT_LT((sum - stated).norm(), 0.05 * stated.norm()) << sum << "\n" << stated;
  // The floor adds to each height on its own.
  const Eigen::Matrix3d floored = probe_covariance(plane, lidar_from_board, probes, 0.01);
  EXPECT_LT((floored - stated - 1e-4 * Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

}  // namespace
}  // namespace lvcalib
