// SPDX-License-Identifier: GPL-3.0-or-later
#include "refinement/node_samples.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "refinement/node_fit.h"
#include "support/simulated_boards.h"

namespace lvcalib {
namespace {

// A LiDAR point anywhere on the ray to a place beside a circle's edge has that place's angle and
// distance, whatever its range error.
TEST(NodeSamples, AngleAndDistanceOfPlacedPoints) {
  const Target target;
  FittedPlane plane;
  plane.normal = Eigen::Vector3d(-1, 0, 0);
  plane.center_m = Eigen::Vector3d(3, 0, 0);
  plane.axis_u = Eigen::Vector3d(0, -1, 0);
  plane.axis_v = Eigen::Vector3d(0, 0, 1);
  const Eigen::Vector2d center(0.1, -0.05);
  Cloud cloud;
  std::vector<std::pair<double, double>> truth;
  for (int k = 0; k < 12; ++k) {
    const double angle = -3.0 + 0.5 * k;
    const double distance = 0.004 * (k % 5 - 2);
    const double r = target.circle_radius_m + distance;
    const Eigen::Vector3d p =
        plane.to_lidar(center + r * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    cloud.points_m.push_back(((1.0 + 0.01 * (k % 3 - 1)) * p).cast<float>());
    cloud.intensity.push_back(static_cast<float>(10 * k));
    truth.emplace_back(angle, distance);
  }
  // Farther out than the nearest tag corner: not this node's.
  cloud.points_m.push_back(plane.to_lidar(center + Eigen::Vector2d(0.2, 0.0)).cast<float>());
  cloud.intensity.push_back(1.0F);
  const auto samples = NodeSampler(cloud, plane, target).around(center);
  ASSERT_EQ(samples.size(), 12U);
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_NEAR(samples[k].angle_rad, truth[k].first, 1e-4);
    EXPECT_NEAR(samples[k].distance_m, truth[k].second, 1e-6);
    EXPECT_EQ(samples[k].point, k);
    EXPECT_EQ(samples[k].intensity, 10.0 * static_cast<double>(k));
  }
}

TEST(NodeSamples, NoCirclesNoSamples) {
  Target target;
  target.type = TargetType::kAprilGrid;
  Cloud cloud;
  cloud.points_m.push_back({3, 0, 0});
  FittedPlane plane;
  plane.normal = Eigen::Vector3d(-1, 0, 0);
  plane.center_m = Eigen::Vector3d(3, 0, 0);
  EXPECT_TRUE(NodeSampler(cloud, plane, target).around({0, 0}).empty());
  EXPECT_TRUE(NodeSampler().around({0, 0}).empty());
}

class RefinedScene : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto options = test::cloud_only_options(11, simulation::LidarKind::kAvia);
    target_ = options.target;
    scene_ = test::simulated_scene(options);
    points_ = test::points_about(scene_.cloud, target_, scene_.lidar_from_board);
    const Rigid3 start = test::off_by(scene_.lidar_from_board, target_, 0.004, 0.003, 5);
    auto result = refine_board(points_, target_, start, RefinementOptions{}, {});
    ASSERT_TRUE(result) << result.error().text();
    refinement_ = std::move(*result);
  }
  Target target_;
  simulation::SimulatedScene scene_;
  Cloud points_;
  BoardRefinement refinement_;
};

// Inside the circle is black, outside is white: the samples carry the print.
TEST_F(RefinedScene, SamplesFollowThePrint) {
  const NodeSampler sampler(points_, refinement_.plane, target_);
  for (const RefinedNode& node : refinement_.nodes) {
    double inside = 0.0;
    double outside = 0.0;
    int n_inside = 0;
    int n_outside = 0;
    for (const NodeSample& s : sampler.around(node.center_uv_m)) {
      if (s.distance_m < -0.01) inside += s.intensity, ++n_inside;
      if (s.distance_m > 0.01) outside += s.intensity, ++n_outside;
    }
    ASSERT_GT(n_inside, 10);
    ASSERT_GT(n_outside, 10);
    EXPECT_GT(outside / n_outside, 3.0 * inside / n_inside);
  }
}

TEST_F(RefinedScene, BoundaryPointsAreThoseBesideSomeCircle) {
  const auto boundary = boundary_points(points_, target_, refinement_);
  ASSERT_GT(boundary.size(), 100U);
  EXPECT_LT(boundary.size(), points_.size());
  const NodeWindow window = node_window(target_);
  for (const std::uint32_t i : boundary) {
    const auto uv = refinement_.plane.ray_hit(points_.points_m[i].cast<double>());
    ASSERT_TRUE(uv);
    double nearest = 1e9;
    for (const RefinedNode& node : refinement_.nodes) {
      nearest = std::min(nearest, (*uv - node.center_uv_m).norm());
    }
    EXPECT_LT(nearest, window.radius_m + window.outside_m + 1e-6);
    EXPECT_GT(nearest, window.radius_m - window.inside_m - 1e-6);
  }
}

// All layout centres move as one rigid body, and end where the last iteration left them: within
// the tolerance of the model's places in the result's own frame.
TEST_F(RefinedScene, CenterPathsEndAtTheModel) {
  const auto paths = center_paths(refinement_);
  ASSERT_EQ(paths.size(), 9U);
  for (const CenterPath& path : paths) {
    ASSERT_EQ(path.predicted_m.size(), refinement_.history.size());
    EXPECT_GT(path.predicted_m.front().norm(), 5e-4);  // The start was millimetres off.
    EXPECT_LT(path.predicted_m.back().norm(), 1e-4);
    const auto node = static_cast<std::size_t>(path.id);
    const double sigma = refinement_.nodes[node].sigma_m();
    EXPECT_NEAR(std::sqrt(0.5 * path.covariance_m2.trace()), sigma, 1e-9);
    EXPECT_LT(path.final_m.norm(), 6.0 * sigma + 5e-4);
  }
}

}  // namespace
}  // namespace lvcalib
