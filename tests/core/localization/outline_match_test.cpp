// SPDX-License-Identifier: GPL-3.0-or-later
#include "localization/outline_match.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/panel_clouds.h"

namespace lvcalib {
namespace {

std::vector<PlanarSample> rectangle(const Eigen::Vector2d& size, double angle,
                                    const Eigen::Vector2d& center, Random& random) {
  std::vector<PlanarSample> samples;
  for (int i = 0; i < 5000; ++i) {
    const double x = size.x() * random.uniform(-0.5, 0.5);
    const double y = size.y() * random.uniform(-0.5, 0.5);
    samples.push_back(
        {(center + Eigen::Rotation2Dd(angle) * Eigen::Vector2d(x, y)).cast<float>(), 0.0F});
  }
  return samples;
}

Target checkerboard(double width, double height) {
  Target target;
  target.type = TargetType::kCheckerboard;
  target.corner_columns = 8;
  target.corner_rows = 6;
  target.column_spacing_m = 0.08;
  target.row_spacing_m = 0.08;
  target.board_width_m = width;
  target.board_height_m = height;
  return target;
}

TEST(OutlineFit, MeasuresARectanglesTurnPlaceAndSides) {
  Random random(1);
  for (const double degrees : {0.0, 24.0, 80.0, 150.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const auto fit = fit_outline(rectangle({0.9, 0.6}, angle, {0.2, -0.1}, random), {0.9, 0.6});
    EXPECT_NEAR(std::remainder(fit.angle_rad - angle, std::numbers::pi), 0.0, 0.06);
    EXPECT_LT((fit.center_m - Eigen::Vector2d(0.2, -0.1)).norm(), 0.015);
    EXPECT_LT(fit.side_error_m.cwiseAbs().maxCoeff(), 0.05);
  }
}

TEST(OutlineFit, SaysHowMuchTheSidesDiffer) {
  Random random(2);
  const auto fit = fit_outline(rectangle({0.7, 0.7}, 0.0, {0, 0}, random), {0.9, 0.9});
  EXPECT_NEAR(fit.side_error_m.x(), -0.2, 0.04);
  EXPECT_NEAR(fit.side_error_m.y(), -0.2, 0.04);
}

// A stand under the board lies on one plane with it.
TEST(OutlineFit, AStandDoesNotCount) {
  Random random(4);
  for (const double degrees : {0.0, 24.0, 105.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const Eigen::Vector2d center(0.2, -0.1);
    auto samples = rectangle({0.6, 0.85}, angle, center, random);
    const Eigen::Vector2d below = center + Eigen::Rotation2Dd(angle) * Eigen::Vector2d(0.0, -0.6);
    for (const PlanarSample& s : rectangle({0.05, 0.35}, angle, below, random)) {
      if (random.uniform() < 0.08) samples.push_back(s);
    }
    const auto fit = fit_outline(samples, {0.6, 0.85});
    EXPECT_NEAR(std::remainder(fit.angle_rad - angle, std::numbers::pi), 0.0, 0.06);
    EXPECT_LT((fit.center_m - center).norm(), 0.02);
    EXPECT_LT(fit.side_error_m.cwiseAbs().maxCoeff(), 0.05);
    EXPECT_NEAR(fit.outside, 0.07, 0.04);
  }
}

class OutlinePoses : public ::testing::Test {
 protected:
  // Poses found for a panel of the given size; the plane's own axes are the frame.
  std::vector<PatternMatch> poses(const Eigen::Vector2d& size, const Target& target) {
    Cloud cloud;
    pose_ = test::upright(3.0, 0.3, 0.1, 0.4);
    test::add_panel(cloud, pose_, size, 6000, 0.003, random_);
    VoxelCloud::Options options;
    options.voxel_m = 0.015;
    const VoxelCloud voxels(cloud, options, {});
    PatchSearchOptions search;
    search.board_width_m = target.outline().size_m().x();
    search.board_height_m = target.outline().size_m().y();
    const auto patches = find_planar_patches(voxels, search, {});
    if (patches.empty()) return {};
    patch_ = patches.front();
    if (!width_) return outline_poses(voxels, patch_, target);
    const Eigen::Vector3d along(std::cos(*width_), std::sin(*width_), 0.0);
    return outline_poses(voxels, patch_, target, pose_.rotation * along);
  }
  std::optional<double> width_;  // Told, against the panel's own.
  Random random_{3};
  Rigid3 pose_;
  PlanarPatch patch_;
};

TEST_F(OutlinePoses, EverySymmetricAssignmentIsOffered) {
  const auto rectangular = poses({0.9, 0.7}, checkerboard(0.9, 0.7));
  ASSERT_EQ(rectangular.size(), 2U);
  EXPECT_NEAR(std::abs(rectangular[0].pose.angle_rad - rectangular[1].pose.angle_rad),
              std::numbers::pi, 1e-9);
  for (const PatternMatch& match : rectangular) {
    EXPECT_GT(match.correlation, 0.7);
    EXPECT_GT(match.gain(), 0.0);
    const Eigen::Vector3d center = patch_.center_m + match.pose.center_m.x() * patch_.axis_u +
                                   match.pose.center_m.y() * patch_.axis_v;
    EXPECT_LT((center - pose_.translation).norm(), 0.03);
    const Eigen::Vector3d width = std::cos(match.pose.angle_rad) * patch_.axis_u +
                                  std::sin(match.pose.angle_rad) * patch_.axis_v;
    EXPECT_GT(std::abs(width.dot(pose_.rotation * Eigen::Vector3d::UnitX())), std::cos(0.05));
  }
  EXPECT_EQ(poses({0.8, 0.8}, checkerboard(0.8, 0.8)).size(), 4U);
}

TEST_F(OutlinePoses, AnotherSizeIsRefused) {
  EXPECT_TRUE(poses({0.9, 0.7}, checkerboard(0.5, 1.2)).empty());
  EXPECT_TRUE(poses({0.6, 0.6}, checkerboard(0.9, 0.9)).empty());
  // Holds a board in any place, and a third of it lies beyond.
  EXPECT_TRUE(poses({1.05, 0.7}, checkerboard(0.7, 0.7)).empty());
}

// Of few lines across a board nobody can tell how it stands: where the other scenes say so, that
// is offered as well, if the patch can be a board that stands so.
TEST_F(OutlinePoses, AKnownDirectionIsOfferedAsWell) {
  const Target target = checkerboard(0.9, 0.7);
  for (const double turned : {0.0, 0.2, 1.5}) {
    width_ = turned;
    const auto found = poses({0.9, 0.7}, target);
    ASSERT_EQ(found.size(), turned == 0.2 ? 4U : 2U) << turned;
    if (turned != 0.2) continue;
    const Eigen::Vector3d width = std::cos(found[2].pose.angle_rad) * patch_.axis_u +
                                  std::sin(found[2].pose.angle_rad) * patch_.axis_v;
    EXPECT_NEAR(width.dot(pose_.rotation * Eigen::Vector3d::UnitX()), std::cos(turned), 0.01);
    EXPECT_LT(found[2].correlation, found[0].correlation);
  }
}

TEST_F(OutlinePoses, TheWorseTheFitTheLessItCounts) {
  const auto good = poses({0.9, 0.7}, checkerboard(0.9, 0.7));
  const auto poor = poses({0.8, 0.7}, checkerboard(0.9, 0.7));
  ASSERT_FALSE(good.empty());
  ASSERT_FALSE(poor.empty());
  EXPECT_GT(good[0].gain(), poor[0].gain());
}

}  // namespace
}  // namespace lvcalib
