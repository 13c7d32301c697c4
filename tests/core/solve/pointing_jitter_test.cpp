// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/pointing_jitter.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "solve/surface_noise.h"

namespace lvcalib {
namespace {

constexpr double kPlain = 0.02;
const Eigen::Matrix2d kBlur_rad2 = 2e-6 * Eigen::Matrix2d::Identity();

// Intensities at edges that cross the beam in all directions.
JitterRegression scattered(double horizontal_rad, double vertical_rad, std::uint64_t seed) {
  Random random(seed);
  JitterRegression out;
  const Eigen::Matrix2d assumed =
      Eigen::Vector2d(horizontal_rad * horizontal_rad, vertical_rad * vertical_rad).asDiagonal();
  for (int k = 0; k < 20000; ++k) {
    const double angle = 2.0 * M_PI * random.uniform();
    const Eigen::RowVector2d by_angle =
        300.0 * Eigen::RowVector2d(std::cos(angle), std::sin(angle));
    const double jitter = std::hypot(by_angle(0) * horizontal_rad, by_angle(1) * vertical_rad);
    const double variance = kPlain * kPlain + jitter * jitter;
    out.add(std::sqrt(variance) * random.normal(), variance, by_angle.cwiseAbs2(), assumed);
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

// An edge whose light a spot of Gaussian width blurs, and which shots scatter over: mean and
// variance of the intensity by integration over where the shots go, against g² J + ½ (H J)².
TEST(IntensityVariance, IsThatOfShotsWhichScatterOverAnEdge) {
  constexpr double kSpot_rad = 1e-3;
  for (const double jitter_rad : {1e-4, 3e-4, 5e-4}) {
    const double width = std::hypot(kSpot_rad, jitter_rad);
    for (const double at : {-2.0, -1.0, -0.3, 0.0, 0.7, 1.5, 2.5}) {
      const double x = at * width;
      double mean = 0.0;
      double squares = 0.0;
      double weights = 0.0;
      for (int k = -4000; k <= 4000; ++k) {
        const double z = 1.5e-3 * k;
        const double weight = std::exp(-0.5 * z * z);
        const double seen = 0.5 * std::erfc(-(x + z * jitter_rad) / (kSpot_rad * std::sqrt(2.0)));
        mean += weight * seen;
        squares += weight * seen * seen;
        weights += weight;
      }
      mean /= weights;
      const double variance = squares / weights - mean * mean;
      const double slope = std::exp(-0.5 * at * at) / (std::sqrt(2.0 * M_PI) * width);
      const Eigen::RowVector3d by_blur(-0.5 * at * slope / width, 0.0, 0.0);
      const double j = jitter_rad * jitter_rad;
      const Eigen::Matrix2d jitter_rad2 = Eigen::Vector2d(j, 0.0).asDiagonal();
      const double stated = intensity_variance(kPlain, {slope, 0.0}, by_blur, jitter_rad2);
      // What is left is of third order in the share that jitter has of the width.
      const double share = j / (width * width);
      EXPECT_NEAR(stated - kPlain * kPlain, variance, share * share * share / (4.0 * M_PI) + 1e-12)
          << jitter_rad << " " << at;
    }
  }
}

TEST(JitterRegression, SaysNothingWithoutEdges) {
  EXPECT_FALSE(JitterRegression().jitter_rad2(kBlur_rad2).has_value());
}

}  // namespace
}  // namespace lvcalib
