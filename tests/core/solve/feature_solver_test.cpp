// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/feature_solver.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/statistics.h"
#include "support/pose_matchers.h"
#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;

class ExtrinsicSolver : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<SceneObservations> scenes(int count, std::uint64_t seed) const {
    return test::observed_scenes(count, target_, camera_, truth_, noise_, seed);
  }
  [[nodiscard]] Result<ExtrinsicSolution> solve(
      const std::vector<SceneObservations>& observations) const {
    return solve_extrinsic({observations, camera_, target_, options_});
  }
  // The truth lies within the 99.9 % ellipsoid of the stated covariance.
  void expect_within_covariance(const ExtrinsicSolution& solution) const {
    EXPECT_LT(test::chi_square_of(solution.camera_from_lidar, truth_), chi_square_gate(6, 1e-3))
        << test::pose_difference(solution.camera_from_lidar.transform, truth_);
  }

  Target target_;
  Camera camera_ = test::test_camera();
  Rigid3 truth_ = test::test_extrinsic();
  test::ObservationNoise noise_;
  ExtrinsicOptions options_;
};

TEST_F(ExtrinsicSolver, NoiseFreeObservationsGiveTheTruth) {
  noise_ = {0.0, 0.0, 0.0, 0.0};
  const auto solution = solve(scenes(3, 1));
  ASSERT_TRUE(solution.ok());
  EXPECT_THAT(solution->camera_from_lidar.transform, test::IsNearPose(truth_, 1e-4, 1e-4));
  EXPECT_EQ(solution->rank, 6);
  EXPECT_LT(solution->rms_px, 1e-4);
  EXPECT_LT(solution->rms_mm, 1e-3);
}

// Coverage over many draws: the stated covariance must hold the truth as often as it says.
// 100 draws at 95 %: four standard deviations of the binomial are ±8.7.
TEST_F(ExtrinsicSolver, CovarianceCoversTheTruth) {
  target_.tag_columns = 3;
  target_.tag_rows = 3;
  constexpr int kDraws = 100;
  int inside = 0;
  std::vector<double> normalized;
  std::vector<double> sigma_px;
  for (int draw = 0; draw < kDraws; ++draw) {
    const auto solution = solve(scenes(3, 100 + static_cast<std::uint64_t>(draw)));
    ASSERT_TRUE(solution.ok());
    inside += test::chi_square_of(solution->camera_from_lidar, truth_) < chi_square_gate(6, 0.05);
    const Vector6d d = se3_log(truth_ * solution->camera_from_lidar.transform.inverse());
    for (int k = 0; k < 6; ++k) {
      normalized.push_back(d(k) / std::sqrt(solution->camera_from_lidar.covariance(k, k)));
    }
    sigma_px.push_back(solution->sigma_px);
  }
  EXPECT_GE(inside, 87);
  EXPECT_LE(inside, 100);
  EXPECT_GT(rms(normalized), 0.88);
  EXPECT_LT(rms(normalized), 1.12);
  // The corner noise is nobody's input: it comes out of the residuals.
  EXPECT_NEAR(std::accumulate(sigma_px.begin(), sigma_px.end(), 0.0) / kDraws, noise_.corner_px,
              0.02 * noise_.corner_px);
}

TEST_F(ExtrinsicSolver, ResidualsAreReportedPerSceneCornerAndNode) {
  const auto solution = solve(scenes(3, 2));
  ASSERT_TRUE(solution.ok());
  ASSERT_EQ(solution->scenes.size(), 3U);
  EXPECT_EQ(solution->used_scenes, 3);
  // A corner's distance has two coordinates.
  EXPECT_NEAR(solution->rms_px, std::sqrt(2.0) * noise_.corner_px, 0.01);
  // A node's has two in the plane, of which a share goes into the pose.
  EXPECT_NEAR(solution->rms_mm, std::sqrt(2.0) * 1e3 * noise_.node_m, 0.15);
  for (const SceneSolution& scene : solution->scenes) {
    EXPECT_TRUE(scene.used);
    EXPECT_TRUE(scene.reason.empty());
    EXPECT_EQ(scene.corners.size(), 64U);
    EXPECT_EQ(scene.nodes.size(), 9U);
    double sum = 0.0;
    for (const CornerResidual& c : scene.corners) sum += c.residual_px.squaredNorm();
    EXPECT_NEAR(scene.rms_px, std::sqrt(sum / 64.0), 1e-9);
  }
  EXPECT_THAT(solution->scenes[1].camera_from_board,
              test::IsNearPose(test::spread_board(target_, 1), 1.0, 1.0));
}

TEST_F(ExtrinsicSolver, ABadTagIsLeftOutAndMarked) {
  auto observations = scenes(3, 3);
  for (CornerObservation& c : observations[1].corners) {
    if (c.feature_id == 6) c.pixel += Eigen::Vector2d(1.5, -1.0);
  }
  const auto solution = solve(observations);
  ASSERT_TRUE(solution.ok());
  for (std::size_t s = 0; s < 3; ++s) {
    for (const CornerResidual& c : solution->scenes[s].corners) {
      EXPECT_EQ(c.used, !(s == 1 && c.feature_id == 6)) << "scene " << s << " tag " << c.feature_id;
    }
  }
  EXPECT_NEAR(solution->sigma_px, noise_.corner_px, 0.01);
  expect_within_covariance(*solution);
}

TEST_F(ExtrinsicSolver, ABadNodeIsLeftOutAndMarked) {
  auto observations = scenes(3, 4);
  RefinedNode& bad = observations[2].nodes[4];
  bad.center_uv_m += Eigen::Vector2d(0.006, -0.003);
  bad.center_lidar_m = observations[2].plane.to_lidar(bad.center_uv_m);
  const auto solution = solve(observations);
  ASSERT_TRUE(solution.ok());
  for (std::size_t s = 0; s < 3; ++s) {
    for (const NodeResidual& n : solution->scenes[s].nodes) {
      EXPECT_EQ(n.used, !(s == 2 && n.id == 4)) << "scene " << s << " node " << n.id;
    }
  }
  EXPECT_NEAR(solution->scenes[2].nodes[4].residual_m.norm(), std::hypot(0.006, 0.003), 0.0015);
  expect_within_covariance(*solution);
}

TEST_F(ExtrinsicSolver, NodesMarkedInvalidTakeNoPart) {
  auto observations = scenes(3, 5);
  observations[0].nodes[3].valid = false;
  observations[0].nodes[3].center_lidar_m.setConstant(7.0);
  observations[0].nodes[3].covariance_m2.setZero();
  const auto solution = solve(observations);
  ASSERT_TRUE(solution.ok());
  EXPECT_FALSE(solution->scenes[0].nodes[3].used);
  EXPECT_LT(solution->rms_mm, 1.0);
  expect_within_covariance(*solution);
}

// The board is moved between cloud and image: the LiDAR side of one scene is off as a whole.
void move_board(SceneObservations& scene, const Rigid3& moved_from_lidar) {
  scene.lidar_from_board = moved_from_lidar * scene.lidar_from_board;
  scene.plane.center_m = moved_from_lidar * scene.plane.center_m;
  for (Eigen::Vector3d* axis : {&scene.plane.normal, &scene.plane.axis_u, &scene.plane.axis_v}) {
    *axis = moved_from_lidar.rotation * *axis;
  }
  for (RefinedNode& node : scene.nodes)
    node.center_lidar_m = moved_from_lidar * node.center_lidar_m;
}

TEST_F(ExtrinsicSolver, ASceneThatContradictsAllOthersIsLeftOutAndSaysByHowMuch) {
  auto observations = scenes(4, 6);
  move_board(observations[2], {so3_exp({0.0, 0.0, 0.005}), {0.01, 0.03, 0.0}});
  const auto solution = solve(observations);
  ASSERT_TRUE(solution.ok());
  EXPECT_EQ(solution->used_scenes, 3);
  for (std::size_t s = 0; s < 4; ++s) EXPECT_EQ(solution->scenes[s].used, s != 2);
  EXPECT_THAT(solution->scenes[2].reason, HasSubstr("contradicts the other scenes by"));
  EXPECT_THAT(solution->scenes[2].reason, HasSubstr(" mm"));
  expect_within_covariance(*solution);
  // If wished, all scenes stay in, and the misfit shows.
  options_.reject_bad_scenes = false;
  const auto all = solve(observations);
  ASSERT_TRUE(all.ok());
  EXPECT_EQ(all->used_scenes, 4);
  EXPECT_GT(all->node_scale, 3.0);
}

TEST_F(ExtrinsicSolver, OfTwoContradictingScenesNeitherIsBlamed) {
  auto observations = scenes(2, 7);
  move_board(observations[1], {so3_exp({0.0, 0.0, 0.005}), {0.01, 0.03, 0.0}});
  const auto solution = solve(observations);
  ASSERT_TRUE(solution.ok());
  EXPECT_EQ(solution->used_scenes, 2);
  EXPECT_GT(std::max(solution->node_scale, solution->plane_scale), 3.0);
}

TEST_F(ExtrinsicSolver, GoodScenesAreNotLeftOut) {
  for (std::uint64_t seed = 20; seed < 30; ++seed) {
    const auto solution = solve(scenes(4, seed));
    ASSERT_TRUE(solution.ok());
    EXPECT_EQ(solution->used_scenes, 4) << "seed " << seed;
  }
}

TEST_F(ExtrinsicSolver, NodesNoisierThanStatedWidenTheirScale) {
  noise_.node_m = 1.2e-3;
  auto observations = scenes(5, 8);
  for (SceneObservations& scene : observations) {
    for (RefinedNode& node : scene.nodes) node.covariance_m2 /= 9.0;
  }
  const auto solution = solve(observations);
  ASSERT_TRUE(solution.ok());
  EXPECT_NEAR(solution->node_scale, 3.0, 0.6);
  expect_within_covariance(*solution);
}

TEST_F(ExtrinsicSolver, UnusableInputIsRefused) {
  for (const auto& observations : {std::vector<SceneObservations>{}, [&] {
                                     auto unused = scenes(3, 9);
                                     for (auto& scene : unused) scene.use = false;
                                     return unused;
                                   }()}) {
    const auto solution = solve(observations);
    ASSERT_FALSE(solution.ok());
    EXPECT_EQ(solution.error().kind, ErrorKind::kUntrusted);
    EXPECT_THAT(solution.error().message, HasSubstr("no usable scene"));
  }
}

TEST_F(ExtrinsicSolver, AStartBehindTheCameraIsRefused) {
  auto observations = scenes(2, 10);
  observations[0].camera_from_board.translation.z() = -3.0;
  const auto solution = solve(observations);
  ASSERT_FALSE(solution.ok());
  EXPECT_EQ(solution.error().kind, ErrorKind::kUntrusted);
  EXPECT_EQ(solution.error().where, "A");
}

TEST_F(ExtrinsicSolver, WithoutNodesThreeTurnedScenesSufficeAndTwoAreRefused) {
  target_.type = TargetType::kAprilGrid;
  const auto three = solve(scenes(4, 11));
  ASSERT_TRUE(three.ok());
  EXPECT_EQ(three->rank, 6);
  expect_within_covariance(*three);
  // Heights over the planes stand for the node residuals: far below a millimetre.
  EXPECT_GT(three->rms_mm, 0.0);
  EXPECT_LT(three->rms_mm, 0.5);
  const auto two = solve(scenes(2, 11));
  ASSERT_FALSE(two.ok());
  EXPECT_EQ(two.error().kind, ErrorKind::kUntrusted);
  EXPECT_THAT(two.error().message, HasSubstr("three or more"));
  EXPECT_FALSE(two.error().hint.empty());
}

TEST_F(ExtrinsicSolver, ParallelBoardsWithoutNodesLeaveDirectionsOpenAndNamesThem) {
  target_.type = TargetType::kAprilGrid;
  Random random(12);
  std::vector<SceneObservations> observations;
  for (const Eigen::Vector3d& center : {Eigen::Vector3d(0, 0, 2.5), Eigen::Vector3d(0.3, 0.1, 3.0),
                                        Eigen::Vector3d(-0.3, 0, 3.5)}) {
    observations.push_back(test::observed_scene("P", target_, camera_, truth_,
                                                test::facing_board(target_, center, {0, 0, 0}),
                                                noise_, random));
  }
  const auto solution = solve(observations);
  ASSERT_TRUE(solution.ok());
  // A plane and its like fix one translation and two rotations. The noise of their normals alone
  // feigns a little more, so that the rank may be full; but no weak direction goes unnamed.
  ASSERT_FALSE(solution->weak_directions.empty());
  std::string all;
  for (const Message& direction : solution->weak_directions) all += direction.text() + "\n";
  EXPECT_THAT(all, HasSubstr("translation along the camera's x axis"));
  EXPECT_THAT(all, HasSubstr("translation along the camera's y axis"));
  // An open direction never looks certain.
  EXPECT_GT(solution->camera_from_lidar.covariance(0, 0), 1.0);
  EXPECT_LT(solution->camera_from_lidar.covariance(2, 2), 1e-4);
}

TEST_F(ExtrinsicSolver, NodesDetermineEverythingInASingleScene) {
  const auto solution = solve(scenes(1, 13));
  ASSERT_TRUE(solution.ok());
  EXPECT_EQ(solution->rank, 6);
  EXPECT_TRUE(solution->leave_one_out.empty());
  expect_within_covariance(*solution);
}

TEST_F(ExtrinsicSolver, SolvingAgainIsRepeatable) {
  auto observations = scenes(4, 14);
  const auto first = solve(observations);
  observations[1].use = false;
  const auto without = solve(observations);
  observations[1].use = true;
  const auto again = solve(observations);
  ASSERT_TRUE(first.ok() && without.ok() && again.ok());
  EXPECT_EQ(first->camera_from_lidar.transform.matrix(),
            again->camera_from_lidar.transform.matrix());
  EXPECT_EQ(first->camera_from_lidar.covariance, again->camera_from_lidar.covariance);
  EXPECT_EQ(without->used_scenes, 3);
  EXPECT_FALSE(without->scenes[1].used);
  EXPECT_FALSE(without->scenes[1].reason.empty());
  // Leaving a scene unused is the same as not having it.
  observations.erase(observations.begin() + 1);
  const auto erased = solve(observations);
  ASSERT_TRUE(erased.ok());
  EXPECT_THAT(erased->camera_from_lidar.transform,
              test::IsNearPose(without->camera_from_lidar.transform, 1e-6, 1e-6));
}

TEST_F(ExtrinsicSolver, LeaveOneOutIsTheMoveOfTheExtrinsicWithoutTheScene) {
  auto observations = scenes(4, 15);
  const auto all = solve(observations);
  ASSERT_TRUE(all.ok());
  ASSERT_EQ(all->leave_one_out.size(), 4U);
  for (std::size_t s = 0; s < 4; ++s) {
    EXPECT_EQ(all->leave_one_out[s].without, observations[s].name);
    observations[s].use = false;
    const auto without = solve(observations);
    observations[s].use = true;
    ASSERT_TRUE(without.ok());
    const Rigid3& a = all->camera_from_lidar.transform;
    const Rigid3& b = without->camera_from_lidar.transform;
    // The noise scales are kept when a scene is left out, so that the two differ slightly.
    const double rotation = 1e3 * rotation_distance_rad(a, b);
    EXPECT_NEAR(all->leave_one_out[s].rotation_mrad, rotation, 0.1 * rotation + 0.02);
    EXPECT_GT(all->leave_one_out[s].translation_mm, 0.0);
    EXPECT_LT(all->leave_one_out[s].translation_mm, 5.0);
  }
  EXPECT_TRUE(solve(scenes(2, 15))->leave_one_out.empty());
}

TEST(ClosedFormExtrinsic, IsExactForExactPosesAndIgnoresUnusedScenes) {
  const Target target;
  const Rigid3 truth = test::test_extrinsic();
  std::vector<SceneObservations> scenes(3);
  for (int s = 0; s < 3; ++s) {
    auto& scene = scenes[static_cast<std::size_t>(s)];
    scene.camera_from_board = test::spread_board(target, s);
    scene.lidar_from_board = truth.inverse() * scene.camera_from_board;
  }
  EXPECT_THAT(closed_form_extrinsic(scenes, target), test::IsNearPose(truth, 1e-9, 1e-5));
  scenes[1].use = false;
  scenes[1].lidar_from_board.translation.x() += 5.0;
  EXPECT_THAT(closed_form_extrinsic(scenes, target), test::IsNearPose(truth, 1e-9, 1e-5));
  scenes.resize(1);
  EXPECT_THAT(closed_form_extrinsic(scenes, target), test::IsNearPose(truth, 1e-9, 1e-5));
  EXPECT_EQ(closed_form_extrinsic({}, target).matrix(), Eigen::Matrix4d::Identity());
}

}  // namespace
}  // namespace lvcalib
