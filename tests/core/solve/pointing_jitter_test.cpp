// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/pointing_jitter.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"

namespace lvcalib {
namespace {

constexpr double kPlain = 0.02;
const Eigen::Matrix2d kBlur_rad2 = 2e-6 * Eigen::Matrix2d::Identity();

// Intensities at edges that cross the beam in all directions.
JitterRegression scattered(double horizontal_rad, double vertical_rad, std::uint64_t seed) {
  Random random(seed);
  JitterRegression out;
  for (int k = 0; k < 20000; ++k) {
    const double angle = 2.0 * M_PI * random.uniform();
    const Eigen::RowVector2d by_angle =
        300.0 * Eigen::RowVector2d(std::cos(angle), std::sin(angle));
    const double jitter = std::hypot(by_angle(0) * horizontal_rad, by_angle(1) * vertical_rad);
    const double variance = kPlain * kPlain + jitter * jitter;
    out.add(by_angle, std::sqrt(variance) * random.normal(), kPlain * kPlain, variance);
  }
  return out;
}

TEST(JitterRegression, TellsTheJitterOfEachAngle) {
  const auto jitter = scattered(4e-4, 2e-4, 5).jitter_rad2(kBlur_rad2);
  ASSERT_TRUE(jitter.has_value());
  EXPECT_NEAR((*jitter)(0, 0), 16e-8, 1e-8);
  EXPECT_NEAR((*jitter)(1, 1), 4e-8, 1e-8);
  EXPECT_EQ((*jitter)(0, 1), 0.0);
}

TEST(JitterRegression, IsNeverNegativeNorMoreThanTheBlur) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto none = scattered(0.0, 0.0, seed).jitter_rad2(kBlur_rad2);
    ASSERT_TRUE(none.has_value());
    EXPECT_GE(none->diagonal().minCoeff(), 0.0);
    EXPECT_LT(none->diagonal().maxCoeff(), 1e-8);
  }
  const auto all = scattered(3e-3, 3e-3, 9).jitter_rad2(kBlur_rad2);
  EXPECT_EQ(*all, kBlur_rad2);
}

TEST(JitterRegression, SaysNothingWithoutEdges) {
  EXPECT_FALSE(JitterRegression().jitter_rad2(kBlur_rad2).has_value());
}

}  // namespace
}  // namespace lvcalib
