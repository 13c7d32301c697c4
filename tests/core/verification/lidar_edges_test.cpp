// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/lidar_edges.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"

namespace lvcalib {
namespace {

constexpr double kStep_rad = 0.003;
// A panel 3 m ahead from −0.1 to 0.1 rad across and up, before a wall 5 m ahead. Its left half is
// dark.
constexpr double kHalf_rad = 0.1;

struct Scan {
  double tilt = 0.0;  // Slope of the wall across.
  double noise_m = 0.008;
  bool with_lines = true;
  bool panel = true;
};

Cloud scan(const Scan& how) {
  Cloud cloud;
  Random random(3);
  for (int line = 0; line < 40; ++line) {
    for (int k = -100; k <= 100; ++k) {
      const double elevation = (line - 19.5) * 2.0 * kStep_rad;
      const double azimuth = k * kStep_rad;
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const bool on_panel =
          how.panel && std::abs(azimuth) < kHalf_rad && std::abs(elevation) < kHalf_rad;
      // The wall: x + tilt·y = 5.
      const double range = (on_panel ? 3.0 / ray.x() : 5.0 / (ray.x() + how.tilt * ray.y())) +
                           random.normal(0.0, how.noise_m);
      cloud.points_m.push_back((range * ray).cast<float>());
      const double bright = on_panel ? (azimuth > 0.0 ? 20.0 : 120.0) : 80.0;
      cloud.intensity.push_back(static_cast<float>(bright + random.normal(0.0, 4.0)));
      if (how.with_lines) cloud.line.push_back(static_cast<std::uint16_t>(line));
    }
  }
  return cloud;
}

double azimuth_of(const LidarEdge& edge) {
  return std::atan2(edge.point_m.y(), edge.point_m.x());
}

TEST(LidarEdges, StandWhereASurfaceEndsOnTheNearerOne) {
  const auto edges = lidar_edges(scan({}), Eigen::Vector3d::UnitX());
  int left = 0, right = 0;
  for (const LidarEdge& e : edges) {
    if (e.kind != LidarEdge::Kind::kRange) continue;
    EXPECT_NEAR(e.point_m.x(), 3.0, 0.05);
    EXPECT_NEAR(std::abs(azimuth_of(e)), kHalf_rad, 0.5 * kStep_rad + 1e-9);
    EXPECT_NEAR(e.spacing_rad, kStep_rad, 0.2 * kStep_rad);
    // Towards the wall.
    EXPECT_GT(e.across.y() * azimuth_of(e), 0.0);
    ++(azimuth_of(e) > 0.0 ? left : right);
  }
  // The lines that cross the panel: 34 lie within 0.1 rad.
  EXPECT_EQ(left, 34);
  EXPECT_EQ(right, 34);
}

TEST(LidarEdges, ABrightnessStepOnASurfaceCountsAndOneAtItsEndDoesNot) {
  const auto edges = lidar_edges(scan({}), Eigen::Vector3d::UnitX());
  int steps = 0;
  for (const LidarEdge& e : edges) {
    if (e.kind != LidarEdge::Kind::kIntensity) continue;
    EXPECT_LT(std::abs(azimuth_of(e)), 2.0 * kStep_rad);
    EXPECT_GT(e.across.y(), 0.9);  // The darker half is on the left.
    ++steps;
  }
  EXPECT_GE(steps, 32);
  EXPECT_LE(steps, 36);
}

TEST(LidarEdges, ASlantedWallHasNone) {
  Scan how;
  how.panel = false;
  // 63° of slant: neighbours differ by up to 5 cm.
  how.tilt = 2.0;
  EXPECT_TRUE(lidar_edges(scan(how), Eigen::Vector3d::UnitX()).empty());
}

TEST(LidarEdges, ACloudWithoutOrderIsFollowedOverAGrid) {
  Cloud cloud = scan({});
  Cloud mixed;
  std::vector<std::size_t> order(cloud.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  Random random(5);
  for (std::size_t i = order.size() - 1; i > 0; --i)
    std::swap(order[i], order[random.below(static_cast<std::uint32_t>(i + 1))]);
  for (const std::size_t i : order) mixed.points_m.push_back(cloud.points_m[i]);
  const auto edges = lidar_edges(mixed, Eigen::Vector3d::UnitX());
  int sides = 0, ends = 0;
  for (const LidarEdge& e : edges) {
    const double elevation = std::asin(e.point_m.z() / e.point_m.norm());
    const bool side = std::abs(std::abs(azimuth_of(e)) - kHalf_rad) < 3.0 * kStep_rad;
    const bool end = std::abs(std::abs(elevation) - kHalf_rad) < 5.0 * kStep_rad;
    EXPECT_TRUE(side || end) << azimuth_of(e) << ' ' << elevation;
    sides += side ? 1 : 0;
    ends += end && !side ? 1 : 0;
  }
  // Rows cross the sides, columns the ends.
  EXPECT_GT(sides, 30);
  EXPECT_GT(ends, 30);
}

TEST(LidarEdges, NothingComesOfNothing) {
  EXPECT_TRUE(lidar_edges({}, Eigen::Vector3d::UnitX()).empty());
  Cloud one;
  one.points_m.push_back({1.0F, 2.0F, 3.0F});
  EXPECT_TRUE(lidar_edges(one, Eigen::Vector3d::UnitX()).empty());
}

}  // namespace
}  // namespace lvcalib
