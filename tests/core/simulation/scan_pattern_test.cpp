// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/scan_pattern.h"

#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

namespace lvcalib::simulation {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

ScanPattern pattern_of(LidarKind kind, int points = 0, int lines = 64) {
  LidarOptions options;
  options.kind = kind;
  options.points = points;
  options.lines = lines;
  return ScanPattern(options, Random(3));
}

TEST(ScanPattern, RosetteFillsItsConeAndDensityVariesTwentyfold) {
  const ScanPattern pattern = pattern_of(LidarKind::kRosette);
  ASSERT_EQ(pattern.size(), 200'000U);
  double widest = 0.0;
  // Rings of the same solid angle.
  std::vector<int> rings(400, 0);
  const double cap = 1.0 - std::cos(35.2 * kDegree);
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const Shot shot = pattern.shot(i);
    ASSERT_NEAR(shot.direction.norm(), 1.0, 1e-12);
    ASSERT_TRUE(pattern.in_field(shot.direction));
    widest = std::max(widest, std::acos(shot.direction.x()));
    ++rings[std::min<std::size_t>(399,
                                  static_cast<std::size_t>(400 * (1 - shot.direction.x()) / cap))];
  }
  EXPECT_NEAR(widest / kDegree, 35.2, 0.1);
  const auto [least, most] = std::minmax_element(rings.begin(), rings.end());
  EXPECT_GT(*least, 0);
  EXPECT_GT(*most, 15 * *least);
}

TEST(ScanPattern, RosetteDoesNotRepeat) {
  const ScanPattern pattern = pattern_of(LidarKind::kRosette);
  // A direction at mid radius is not met again to within a tenth of the sampling step.
  const Eigen::Vector3d first = pattern.shot(130).direction;
  double nearest = 1.0;
  for (std::size_t i = 1000; i < pattern.size(); ++i) {
    nearest = std::min(nearest, (pattern.shot(i).direction - first).norm());
  }
  EXPECT_GT(nearest, 1e-5);
}

TEST(ScanPattern, AviaHasSixLinesFannedInElevation) {
  const ScanPattern pattern = pattern_of(LidarKind::kAvia);
  std::set<int> lines;
  double top = 0.0;
  double side = 0.0;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const Shot shot = pattern.shot(i);
    lines.insert(shot.line);
    top = std::max(top, std::asin(shot.direction.z()));
    side = std::max(side, std::atan2(shot.direction.y(), shot.direction.x()));
  }
  EXPECT_EQ(lines, (std::set<int>{0, 1, 2, 3, 4, 5}));
  EXPECT_NEAR(top / kDegree, 38.6, 0.2);
  EXPECT_NEAR(side / kDegree, 35.2, 0.3);
  EXPECT_NEAR(pattern.shot(pattern.size() - 1).time_s, 1.0, 1e-4);
}

TEST(ScanPattern, SpinningHasLevelLinesAndShiftedRevolutions) {
  const ScanPattern pattern = pattern_of(LidarKind::kSpinning);
  ASSERT_EQ(pattern.size(), 5U * 1800U * 64U);
  const auto azimuth = [&](std::size_t revolution) {
    const Eigen::Vector3d d = pattern.shot(revolution * 1800 * 64 + 900 * 64 + 10).direction;
    return std::atan2(d.y(), d.x());
  };
  EXPECT_EQ(pattern.shot(10).line, 10);
  EXPECT_NEAR(std::asin(pattern.shot(63).direction.z()) / kDegree, 22.5, 1e-9);
  EXPECT_NEAR(std::asin(pattern.shot(64).direction.z()) / kDegree, -22.5, 1e-9);
  EXPECT_GT(std::abs(azimuth(0) - azimuth(1)), 1e-6);
  EXPECT_LT(std::abs(azimuth(0) - azimuth(1)), 0.2 * kDegree);
  EXPECT_FALSE(pattern.in_field({1.0, 0.0, std::tan(23 * kDegree)}));
  EXPECT_TRUE(pattern.in_field({-1.0, 0.3, 0.0}));
}

TEST(ScanPattern, DirectionAtAnotherTimeIsThatOfTheShotThen) {
  for (const auto kind : {LidarKind::kRosette, LidarKind::kAvia, LidarKind::kSpinning}) {
    const ScanPattern pattern = pattern_of(kind, 50'000);
    // Shots of the same line, two rounds of all lines apart.
    const std::size_t lines = kind == LidarKind::kRosette ? 1 : kind == LidarKind::kAvia ? 6 : 64;
    for (std::size_t i = 600; i < 40'000; i += 1'357) {
      const Shot shot = pattern.shot(i);
      const Shot later = pattern.shot(i + 2 * lines);
      ASSERT_EQ(shot.line, later.line);
      EXPECT_LT((pattern.direction_at(shot, later.time_s) - later.direction).norm(), 1e-9);
      EXPECT_LT((pattern.direction_at(shot, shot.time_s) - shot.direction).norm(), 1e-15);
    }
  }
}

}  // namespace
}  // namespace lvcalib::simulation
