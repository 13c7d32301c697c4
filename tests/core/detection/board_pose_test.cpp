// SPDX-License-Identifier: GPL-3.0-or-later
#include "detection/board_pose.h"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/random.h"
#include "support/rendered_board.h"

namespace lvcalib {
namespace {

std::vector<CornerObservation> observe(const Target& target, const Camera& camera,
                                       const Rigid3& pose, double sigma_px, Random& random) {
  std::vector<CornerObservation> out;
  for (const TargetTag& tag : target.tags()) {
    const auto board = target.tag_corners_m(tag);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto pixel = camera.project(pose * Eigen::Vector3d(board[k].x(), board[k].y(), 0));
      if (!pixel) continue;
      const Eigen::Vector2d noise(random.normal(0, sigma_px), random.normal(0, sigma_px));
      out.push_back({tag.id, static_cast<int>(k), board[k], *pixel + noise, 0.0});
    }
  }
  return out;
}

Camera wide_camera() {
  Camera camera = testing::pinhole(1440, 900, 1020);
  camera.distortion.head<4>() << -0.08, 0.04, -0.0003, -0.0003;
  return camera;
}

TEST(BoardPose, StatedCovarianceCoversTheTruth) {
  const Target target;
  const Camera camera = wide_camera();
  Random random(11);
  const int runs = 300;
  int covered = 0;
  double sum = 0.0, sigma_sum = 0.0;
  for (int i = 0; i < runs; ++i) {
    Rigid3 pose = testing::facing_pose(target, random.uniform(2, 4), random.uniform(-0.3, 0.3),
                                       random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6));
    pose.translation.x() += random.uniform(-0.4, 0.4);
    const auto fit = estimate_board_pose(observe(target, camera, pose, 0.05, random), camera, {});
    ASSERT_TRUE(fit.ok());
    const Vector6d error = se3_log(pose * fit->camera_from_board.transform.inverse());
    const double distance = error.dot(fit->camera_from_board.covariance.inverse() * error);
    sum += distance;
    sigma_sum += fit->sigma_px;
    covered += distance < 12.592 ? 1 : 0;  // 95 % of χ² with six degrees of freedom
  }
  EXPECT_NEAR(static_cast<double>(covered) / runs, 0.95, 0.035);
  EXPECT_NEAR(sum / runs, 6.0, 0.6);
  EXPECT_NEAR(sigma_sum / runs, 0.05, 0.002);
}

TEST(BoardPose, OutliersDoNotMoveIt) {
  const Target target;
  const Camera camera = wide_camera();
  Random random(12);
  const Rigid3 pose = testing::facing_pose(target, 3.0, 0.1, 0.4, -0.3);
  auto corners = observe(target, camera, pose, 0.05, random);
  for (std::size_t i = 0; i < 12; ++i) corners[i].pixel += Eigen::Vector2d(25 + 3.0 * i, -18);
  corners[40].pixel.x() += 1.0;
  const auto fit = estimate_board_pose(corners, camera, {});
  ASSERT_TRUE(fit.ok());
  EXPECT_LT(translation_distance_m(fit->camera_from_board.transform, pose), 0.003);
  EXPECT_LT(rotation_distance_rad(fit->camera_from_board.transform, pose), 0.003);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i >= 12 && i != 40) continue;
    EXPECT_FALSE(fit->agrees[i]) << i;
  }
  EXPECT_NEAR(fit->sigma_px, 0.05, 0.02);
}

TEST(BoardPose, AmbiguityIsReportedWhereItIsRealAndOnlyThere) {
  Target target;
  target.tag_columns = target.tag_rows = 2;
  const Camera camera = testing::pinhole(1440, 900, 1000);
  Random random(13);
  int near_alternatives = 0, far_resolved = 0, far_alternatives = 0;
  for (int i = 0; i < 20; ++i) {
    // Near: the perspective tells the two poses apart.
    const Rigid3 near = testing::facing_pose(target, 1.0, 0.1, 0.6, 0.1);
    const auto sure = estimate_board_pose(observe(target, camera, near, 0.05, random), camera, {});
    ASSERT_TRUE(sure.ok());
    EXPECT_LT(rotation_distance_rad(sure->camera_from_board.transform, near), 0.01);
    near_alternatives += sure->alternative_pose ? 1 : 0;
    // Far and noisy: it does not.
    const Rigid3 far = testing::facing_pose(target, 12.0, 0.1, 0.3, 0.1);
    const auto unsure = estimate_board_pose(observe(target, camera, far, 0.5, random), camera, {});
    ASSERT_TRUE(unsure.ok());
    const bool right = rotation_distance_rad(unsure->camera_from_board.transform, far) < 0.3;
    const bool other =
        unsure->alternative_pose && rotation_distance_rad(*unsure->alternative_pose, far) < 0.3;
    far_resolved += right || other ? 1 : 0;
    far_alternatives += unsure->alternative_pose ? 1 : 0;
  }
  EXPECT_EQ(near_alternatives, 0);
  EXPECT_GE(far_alternatives, 12);
  EXPECT_GE(far_resolved, 18);
}

TEST(BoardPose, WorksFarOffTheAxisOfAFisheye) {
  Camera camera = testing::pinhole(1000, 1000, 300);
  camera.model = DistortionModel::kEquidistant;
  camera.distortion[0] = -0.02;
  const Target target;
  Random random(14);
  Rigid3 pose = testing::facing_pose(target, 1.0, 0, 0.3, 0);
  pose = Rigid3{so3_exp({0, 1.0, 0}), Eigen::Vector3d::Zero()} * pose;
  const auto fit = estimate_board_pose(observe(target, camera, pose, 0.05, random), camera, {});
  ASSERT_TRUE(fit.ok());
  EXPECT_LT(translation_distance_m(fit->camera_from_board.transform, pose), 0.003);
}

TEST(BoardPose, DegenerateCornersAreErrors) {
  const Camera camera = wide_camera();
  EXPECT_FALSE(estimate_board_pose({}, camera, {}).ok());
  std::vector<CornerObservation> line;
  for (int i = 0; i < 8; ++i) line.push_back({i, 0, {0.1 * i, 0.0}, {500.0 + 40 * i, 400.0}, 0.0});
  EXPECT_FALSE(estimate_board_pose(line, camera, {}).ok());
  std::vector<CornerObservation> same(6, {0, 0, {0.1, 0.1}, {500, 400}, 0.0});
  EXPECT_FALSE(estimate_board_pose(same, camera, {}).ok());
}

}  // namespace
}  // namespace lvcalib
