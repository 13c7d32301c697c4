// SPDX-License-Identifier: GPL-3.0-or-later
#include "response/edge_samples.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lvcalib {
namespace {

// A refined board at a known pose, without noise.
class EdgeSamples : public ::testing::Test {
 protected:
  EdgeSamples() {
    Eigen::Matrix3d R;
    R.col(0) = Eigen::Vector3d(0, -1, 0);
    R.col(1) = Eigen::Vector3d(0, 0, 1);
    R.col(2) = Eigen::Vector3d(-1, 0, 0);
    refinement_.lidar_from_board =
        Rigid3{so3_exp({0.0, 0.2, 0.3}), {0, 0, 0}} * Rigid3::from_matrix(R, {3.0, 0.3, -0.3});
    const Rigid3& pose = refinement_.lidar_from_board;
    refinement_.plane.normal = pose.rotation * Eigen::Vector3d::UnitZ();
    refinement_.plane.center_m = pose.translation;
    refinement_.plane.axis_u = pose.rotation * Eigen::Vector3d::UnitX();
    refinement_.plane.axis_v = pose.rotation * Eigen::Vector3d::UnitY();
    refinement_.plane.group_sigma_m = {0.008, 0.008, 0, 0};
    refinement_.footprint_m2 = Eigen::Vector2d(9e-6, 4e-6).asDiagonal();
    for (const TargetNode& node : target_.nodes()) {
      RefinedNode refined;
      refined.id = node.id;
      refined.valid = true;
      refined.board_m = node.center_m;
      refinement_.nodes.push_back(refined);
    }
  }
  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector2d& board) const {
    return refinement_.lidar_from_board * Eigen::Vector3d(board.x(), board.y(), 0.0);
  }
  [[nodiscard]] std::vector<BoundarySample> collect(
      const std::vector<Eigen::Vector3d>& points) const {
    Cloud cloud;
    for (const auto& p : points) {
      cloud.points_m.push_back(p.cast<float>());
      cloud.intensity.push_back(7.0F);
    }
    return collect_edge_samples({"A", &cloud, &refinement_}, target_);
  }
  Target target_;
  BoardRefinement refinement_;
};

TEST_F(EdgeSamples, DistanceIsSignedAndMeasuredFromTheNearestCircle) {
  const Eigen::Vector2d c = refinement_.nodes[4].board_m;
  const double r = target_.circle_radius_m;
  const auto samples =
      collect({at(c + Eigen::Vector2d(r + 0.01, 0)), at(c + Eigen::Vector2d(0, -(r - 0.02))),
               at(c + Eigen::Vector2d(0.5 * target_.tag_pitch_m(), 0))});
  ASSERT_EQ(samples.size(), 2U);  // The third lies on a tag, far from any circle.
  EXPECT_NEAR(samples[0].distance_m, 0.01, 1e-6);
  EXPECT_NEAR(samples[1].distance_m, -0.02, 1e-6);
  EXPECT_EQ(samples[0].node, 4);
  EXPECT_NEAR(samples[0].width_m, 0.003, 1e-6);
  EXPECT_NEAR(samples[1].width_m, 0.002, 1e-6);
}

TEST_F(EdgeSamples, ResidualsLeadFromTheNearestBoundaryPointToTheSample) {
  const Eigen::Vector2d c = refinement_.nodes[0].board_m;
  const Eigen::Vector2d outward = Eigen::Vector2d(0.6, 0.8);
  const Eigen::Vector3d ideal = at(c + target_.circle_radius_m * outward);
  const Eigen::Vector3d point = 1.002 * at(c + (target_.circle_radius_m + 0.004) * outward);
  const auto samples = collect({point});
  ASSERT_EQ(samples.size(), 1U);
  // Angles of both points straight from their coordinates.
  const auto yaw = [](const Eigen::Vector3d& p) { return std::atan2(p.y(), p.x()); };
  const auto pitch = [](const Eigen::Vector3d& p) {
    return std::atan2(p.z(), std::hypot(p.x(), p.y()));
  };
  EXPECT_NEAR(samples[0].residual(0), pitch(point) - pitch(ideal), 3e-6);
  EXPECT_NEAR(samples[0].residual(1), (yaw(point) - yaw(ideal)) * std::cos(pitch(ideal)), 3e-6);
  EXPECT_NEAR(samples[0].residual(2), point.norm() - ideal.norm(), 1e-6);
  EXPECT_NEAR(samples[0].range_residual_m, 0.002 / 1.002 * point.norm(), 1e-6);
}

// The gradients against turning the ray a little.
TEST_F(EdgeSamples, GradientsMatchATurnedRay) {
  const Eigen::Vector2d c = refinement_.nodes[8].board_m;
  const Eigen::Vector3d edge = at(c + target_.circle_radius_m * Eigen::Vector2d(-0.8, 0.6));
  const auto samples = collect({edge});
  ASSERT_EQ(samples.size(), 1U);
  const Eigen::Vector3d yaw_axis = Eigen::Vector3d::UnitZ().cross(edge).normalized();
  const Eigen::Vector3d pitch_axis = edge.normalized().cross(yaw_axis);
  constexpr double kStep = 1e-3;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector3d a = axis == 0 ? pitch_axis : yaw_axis;
    const auto board_hit = [&](double angle) -> Eigen::Vector3d {
      const Eigen::Vector3d ray = (edge.normalized() + angle * a).normalized();
      return ray * refinement_.plane.normal.dot(edge) / refinement_.plane.normal.dot(ray);
    };
    const auto moved = collect({board_hit(kStep), board_hit(-kStep)});
    ASSERT_EQ(moved.size(), 2U);
    EXPECT_NEAR((moved[0].distance_m - moved[1].distance_m) / (2 * kStep),
                samples[0].across_m(axis), 0.01);
    EXPECT_NEAR((board_hit(kStep).norm() - board_hit(-kStep).norm()) / (2 * kStep),
                samples[0].slant_m(axis), 0.01);
  }
}

TEST_F(EdgeSamples, PointsOffThePlaneAndCloudsWithoutIntensityGiveNone) {
  const Eigen::Vector3d p =
      at(refinement_.nodes[4].board_m + Eigen::Vector2d(target_.circle_radius_m, 0));
  EXPECT_EQ(collect({p}).size(), 1U);
  EXPECT_EQ(collect({1.05 * p}).size(), 0U);
  Cloud bare;
  bare.points_m.push_back(p.cast<float>());
  EXPECT_TRUE(collect_edge_samples({"A", &bare, &refinement_}, target_).empty());
}

// What stands before the board there hides the circle's edge, or looks like another one.
TEST_F(EdgeSamples, CoveredPartsGiveNone) {
  const Eigen::Vector2d c = refinement_.nodes[4].board_m;
  const double r = target_.circle_radius_m;
  Cloud cloud;
  for (const double side : {-r, r}) {
    cloud.points_m.push_back(at(c + Eigen::Vector2d(side, 0)).cast<float>());
    cloud.intensity.push_back(7.0F);
  }
  const Eigen::AlignedBox2d left(c - Eigen::Vector2d(2 * r, r), c + Eigen::Vector2d(0, r));
  const auto samples = collect_edge_samples({"A", &cloud, &refinement_, {left}}, target_);
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_GT(samples[0].board_m.x(), c.x());
}

TEST_F(EdgeSamples, OverlapRegionFollowsTheWidthAndKeepsClearOfTags) {
  BoundarySample s;
  s.outward = Eigen::Vector2f(1.0F, 0.0F);  // Along the gap: no tag near.
  s.width_m = 0.004F;
  EXPECT_NEAR(overlap_half_width_m(s, target_, {}), ResponseOptions{}.overlap_sigmas * 0.004, 1e-6);
  EXPECT_TRUE(clear_of_tags(s, target_));
  // Towards a tag's corner, which is this far from the circle's edge:
  s.outward = Eigen::Vector2f(1.0F, 1.0F).normalized();
  const double corner =
      0.5 * std::sqrt(2.0) * target_.tag_spacing * target_.tag_size_m - target_.circle_radius_m;
  EXPECT_NEAR(overlap_half_width_m(s, target_, {}), ResponseOptions{}.overlap_sigmas * 0.004, 1e-6);
  s.width_m = 0.008F;
  EXPECT_NEAR(overlap_half_width_m(s, target_, {}), corner - 2.0 * 0.008, 1e-3);
  s.distance_m = 0.005F;
  EXPECT_TRUE(clear_of_tags(s, target_));
  s.distance_m = 0.015F;
  EXPECT_FALSE(clear_of_tags(s, target_));
}

}  // namespace
}  // namespace lvcalib
