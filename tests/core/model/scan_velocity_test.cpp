// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/scan_velocity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace lvcalib {
namespace {

// Two lines that turn at 20 and −8 rad/s of azimuth and rise at 3 rad/s, points alternating.
Cloud two_lines(std::size_t count) {
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = 1e-4 * static_cast<double>(i);
    const bool first = i % 2 == 0;
    const double az = first ? 3.0 + 20.0 * t : -8.0 * t;
    const double el = 0.3 + 3.0 * t;
    const double r = 3.0 + 0.3 * std::sin(40.0 * t);
    cloud.points_m.push_back(Eigen::Vector3d(r * std::cos(el) * std::cos(az),
                                             r * std::cos(el) * std::sin(az), r * std::sin(el))
                                 .cast<float>());
    cloud.time_s.push_back(static_cast<float>(t));
    cloud.line.push_back(first ? 0 : 1);
  }
  return cloud;
}

TEST(ScanVelocity, IsThatOfEachLine) {
  const Cloud cloud = two_lines(400);  // crosses ±π on the way
  const auto velocity = scan_velocities(cloud);
  ASSERT_EQ(velocity.size(), cloud.size());
  for (std::size_t i = 20; i < 380; ++i) {
    const double el = 0.3 + 3.0 * 1e-4 * static_cast<double>(i);
    const double expected = (i % 2 == 0 ? 20.0 : -8.0) * std::cos(el);
    EXPECT_NEAR(velocity[i].x(), expected, 0.05) << i;
    EXPECT_NEAR(velocity[i].y(), 3.0, 0.05) << i;
  }
}

TEST(ScanVelocity, DoesNotDependOnTheOrderOfPoints) {
  const Cloud cloud = two_lines(200);
  Cloud reversed = cloud;
  std::reverse(reversed.points_m.begin(), reversed.points_m.end());
  std::reverse(reversed.time_s.begin(), reversed.time_s.end());
  std::reverse(reversed.line.begin(), reversed.line.end());
  const auto a = scan_velocities(cloud);
  const auto b = scan_velocities(reversed);
  for (std::size_t i = 0; i < 200; ++i) EXPECT_LT((a[i] - b[199 - i]).norm(), 1e-9);
}

TEST(ScanVelocity, NeedsTimeAndNeighbours) {
  Cloud cloud = two_lines(8);
  for (const auto& v : scan_velocities(cloud)) EXPECT_TRUE(v.isZero());
  cloud.time_s.clear();
  EXPECT_TRUE(scan_velocities(cloud).empty());
}

TEST(ScanVelocity, BesideAGapInTimeOneSideTells) {
  Cloud cloud = two_lines(400);
  const auto before = scan_velocities(cloud);
  for (std::size_t i = 200; i < 400; ++i) cloud.time_s[i] += 1.0F;
  const auto after = scan_velocities(cloud);
  for (const std::size_t i : {198U, 199U, 200U, 201U})
    EXPECT_LT((after[i] - before[i]).norm(), 0.05) << i;
}

TEST(ScanVelocity, IsZeroForAPointByItself) {
  Cloud cloud = two_lines(400);
  for (std::size_t i = 200; i < 400; ++i) cloud.time_s[i] += i < 202 ? 1.0F : 2.0F;
  const auto velocity = scan_velocities(cloud);
  EXPECT_TRUE(velocity[200].isZero());
  EXPECT_TRUE(velocity[201].isZero());
  EXPECT_FALSE(velocity[202].isZero());
}

// At the ends of a stretch a straight line would be a parabola's slope in the middle.
TEST(ScanVelocity, FollowsACurvedScan) {
  Cloud cloud;
  for (int i = 0; i < 40; ++i) {
    const double t = 1e-4 * i;
    const double az = 30.0 * t + 0.5 * 2e4 * t * t;
    cloud.points_m.emplace_back(static_cast<float>(3 * std::cos(az)),
                                static_cast<float>(3 * std::sin(az)), 0.0F);
    cloud.time_s.push_back(static_cast<float>(t));
  }
  const auto velocity = scan_velocities(cloud);
  for (const int i : {0, 1, 20, 39})
    EXPECT_NEAR(velocity[static_cast<std::size_t>(i)].x(), 30.0 + 2e4 * 1e-4 * i, 0.5) << i;
}

TEST(ScanVelocity, PointsThatAreNoReturnsDisturbNobody) {
  Cloud cloud = two_lines(400);
  const auto before = scan_velocities(cloud);
  cloud.points_m[101].setConstant(std::numeric_limits<float>::quiet_NaN());
  cloud.points_m[105].setZero();
  const auto after = scan_velocities(cloud);
  EXPECT_TRUE(after[101].isZero());
  EXPECT_TRUE(after[105].isZero());
  for (std::size_t i = 103; i < 120; i += 4) EXPECT_LT((after[i] - before[i]).norm(), 0.1) << i;
}

}  // namespace
}  // namespace lvcalib
