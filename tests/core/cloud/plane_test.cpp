// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud/plane.h"

#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "base/random.h"
#include "base/rigid3.h"
#include "base/statistics.h"

namespace lvcalib {
namespace {

constexpr double kSigma = 0.008;

// The plane's frame takes the plane z = 0 to the LiDAR frame; z towards the LiDAR.
Rigid3 plane_pose() {
  Eigen::Matrix3d facing;
  facing.col(0) = Eigen::Vector3d(0, -1, 0);
  facing.col(1) = Eigen::Vector3d(0, 0, 1);
  facing.col(2) = Eigen::Vector3d(-1, 0, 0);
  return {so3_exp({0.1, 0.2, 0.6}) * Eigen::Quaterniond(facing), {3.0, 0.4, -0.2}};
}

// Points whose noise lies along the ray, as a LiDAR has it.
std::vector<Eigen::Vector3f> ranged_points(int count, double side_m, double sigma_m,
                                           Random& random) {
  const Rigid3 pose = plane_pose();
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i) {
    const double x = side_m * random.uniform(-0.5, 0.5);
    const double y = side_m * random.uniform(-0.5, 0.5);
    const Eigen::Vector3d p = pose * Eigen::Vector3d(x, y, 0.0);
    points.push_back((p * (1.0 + sigma_m * random.normal() / p.norm())).cast<float>());
  }
  return points;
}

FittedPlane rough_start() {
  const Eigen::Matrix3d R =
      (so3_exp({0.05, -0.03, 0.02}) * plane_pose().rotation).toRotationMatrix();
  FittedPlane start;
  start.axis_u = R.col(0);
  start.axis_v = R.col(1);
  start.normal = R.col(2);
  start.center_m = plane_pose().translation + Eigen::Vector3d(0.02, 0.01, -0.02);
  return start;
}

// Error in the plane's own terms: height and slopes of the truth over the fit.
Eigen::Vector3d error_of(const FittedPlane& plane) {
  const Eigen::Vector3d normal = plane_pose().rotation * Eigen::Vector3d::UnitZ();
  const double along = normal.dot(plane.normal);
  const double height = normal.dot(plane_pose().translation - plane.center_m) / along;
  return {height, -normal.dot(plane.axis_u) / along, -normal.dot(plane.axis_v) / along};
}

TEST(FitPlane, CovarianceCoversTheTruth) {
  Random random(1);
  constexpr int kDraws = 400;
  int inside = 0;
  std::vector<double> normalized;
  for (int draw = 0; draw < kDraws; ++draw) {
    const auto plane = fit_plane(ranged_points(300, 0.9, kSigma, random), rough_start());
    ASSERT_TRUE(plane.has_value());
    const Eigen::Vector3d e = error_of(*plane);
    inside += e.dot(plane->covariance.ldlt().solve(e)) < chi_square_gate(3, 0.05) ? 1 : 0;
    for (int k = 0; k < 3; ++k) normalized.push_back(e(k) / std::sqrt(plane->covariance(k, k)));
    EXPECT_NEAR(plane->sigma_range_m, kSigma, 0.35 * kSigma);
  }
  // 95 %: 380 ± 4.4 by chance alone.
  EXPECT_GE(inside, 0.92 * kDraws);
  EXPECT_LE(inside, 0.98 * kDraws);
  EXPECT_NEAR(rms(normalized), 1.0, 0.08);
}

TEST(FitPlane, FrameIsOrthonormalAndKeepsItsStart) {
  Random random(2);
  const auto plane = fit_plane(ranged_points(2000, 0.9, kSigma, random), rough_start());
  ASSERT_TRUE(plane.has_value());
  EXPECT_LT((plane->axis_u.cross(plane->axis_v) - plane->normal).norm(), 1e-9);
  EXPECT_GT(plane->axis_u.dot(rough_start().axis_u), 0.99);
  EXPECT_LT(plane->normal.dot(plane->center_m), 0.0);
  EXPECT_LT((plane->center_m - plane_pose().translation).norm(), 0.05);
  const Eigen::Vector2d uv(0.2, -0.3);
  EXPECT_LT((plane->to_plane(plane->to_lidar(uv)) - uv).norm(), 1e-12);
  EXPECT_GT(plane->inliers, 1900U);
}

TEST(FitPlane, RangeNoiseDoesNotTiltAPlaneSeenAtASlant) {
  // Least squares of perpendicular distances would do as well here; but the range residual is what
  // the noise is stated in.
  Random random(3);
  const auto plane = fit_plane(ranged_points(20'000, 0.9, 0.02, random), rough_start());
  ASSERT_TRUE(plane.has_value());
  EXPECT_NEAR(plane->sigma_range_m, 0.02, 0.0006);
  const Eigen::Vector3d e = error_of(*plane);
  for (int k = 0; k < 3; ++k) EXPECT_LT(std::abs(e(k)), 4.0 * std::sqrt(plane->covariance(k, k)));
}

TEST(FitPlane, OneFifthOutliersDoNotMatter) {
  Random random(4);
  for (int draw = 0; draw < 20; ++draw) {
    auto points = ranged_points(1000, 0.9, kSigma, random);
    for (std::size_t i = 0; i < points.size(); i += 5) {
      // All on the same side: things before the plane.
      points[i] *= static_cast<float>(1.0 - random.uniform(0.03, 0.4));
    }
    const auto plane = fit_plane(points, rough_start());
    ASSERT_TRUE(plane.has_value());
    const Eigen::Vector3d e = error_of(*plane);
    for (int k = 0; k < 3; ++k) {
      EXPECT_LT(std::abs(e(k)), 5.0 * std::sqrt(plane->covariance(k, k))) << "component " << k;
    }
    EXPECT_LT(plane->inliers, 850U);
    EXPECT_GT(plane->inliers, 750U);
  }
}

TEST(FitPlane, TooFewOrCollinearPointsAreRefused) {
  Random random(5);
  EXPECT_FALSE(fit_plane({}, rough_start()).has_value());
  EXPECT_FALSE(fit_plane(ranged_points(9, 0.9, kSigma, random), rough_start()).has_value());
  EXPECT_TRUE(fit_plane(ranged_points(40, 0.9, kSigma, random), rough_start()).has_value());
  // One scan line, and one place.
  std::vector<Eigen::Vector3f> line;
  const Rigid3 pose = plane_pose();
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p = pose * Eigen::Vector3d(0.005 * i - 0.5, 0.1, 0.0);
    line.push_back((p * (1.0 + kSigma * random.normal() / p.norm())).cast<float>());
  }
  EXPECT_FALSE(fit_plane(line, rough_start()).has_value());
  const std::vector<Eigen::Vector3f> one_place(200, Eigen::Vector3f(3, 0, 0));
  EXPECT_FALSE(fit_plane(one_place, rough_start()).has_value());
}

TEST(FitPlane, NoiseFreePointsAreNoTrouble) {
  Random random(6);
  const auto plane = fit_plane(ranged_points(500, 0.9, 0.0, random), rough_start());
  ASSERT_TRUE(plane.has_value());
  EXPECT_LT(error_of(*plane).norm(), 1e-5);
}

TEST(FittedPlane, RayHitIsFreeOfRangeNoise) {
  FittedPlane plane;
  plane.center_m = {0, 0, 2};
  plane.normal = {0, 0, -1};
  plane.axis_u = {1, 0, 0};
  plane.axis_v = {0, -1, 0};
  const Eigen::Vector3d on_plane(0.4, -0.3, 2.0);
  for (const double factor : {0.9, 1.0, 1.2}) {
    const auto hit = plane.ray_hit(factor * on_plane);
    ASSERT_TRUE(hit.has_value());
    EXPECT_LT((*hit - Eigen::Vector2d(0.4, 0.3)).norm(), 1e-12);
    EXPECT_NEAR(*plane.range_residual_m(factor * on_plane), (factor - 1.0) * on_plane.norm(),
                1e-12);
  }
  // A ray along the plane never meets it.
  EXPECT_FALSE(plane.ray_hit({1.0, 0.0, 0.0}).has_value());
  EXPECT_FALSE(plane.range_residual_m({1.0, 1.0, 0.001}).has_value());
}

TEST(AppendPoint, TakesAllFieldsThatAreThere) {
  Cloud from;
  from.points_m = {{1, 2, 3}, {4, 5, 6}};
  from.intensity = {7, 8};
  from.time_s = {0.1F, 0.2F};
  from.line = {3, 4};
  Cloud to;
  append_point(to, from, 1);
  ASSERT_EQ(to.size(), 1U);
  EXPECT_EQ(to.points_m[0], Eigen::Vector3f(4, 5, 6));
  EXPECT_EQ(to.intensity, std::vector<float>{8});
  EXPECT_EQ(to.time_s, std::vector<float>{0.2F});
  EXPECT_EQ(to.line, std::vector<std::uint16_t>{4});
  from.intensity.clear();
  from.time_s.clear();
  from.line.clear();
  Cloud bare;
  append_point(bare, from, 0);
  EXPECT_FALSE(bare.has_intensity() || bare.has_time() || bare.has_line());
}

TEST(PlaneFrame, AxesTurnFromUTowardsV) {
  PlaneFrame frame;
  frame.normal = {0.0, 0.0, -1.0};
  frame.axis_u = {0.0, 1.0, 0.0};
  frame.axis_v = {1.0, 0.0, 0.0};
  const Eigen::Matrix3d quarter = frame.turned(std::numbers::pi / 2.0);
  EXPECT_NEAR((quarter.col(0) - frame.axis_v).norm(), 0.0, 1e-15);
  EXPECT_NEAR((quarter.col(1) + frame.axis_u).norm(), 0.0, 1e-15);
  EXPECT_EQ(quarter.col(2), frame.normal);
  EXPECT_NEAR(frame.turned(0.3).determinant(), 1.0, 1e-15);
}

}  // namespace
}  // namespace lvcalib
