// SPDX-License-Identifier: GPL-3.0-or-later
#include "camera/radial_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"

namespace lvcalib {
namespace {

bool positive(const std::vector<double>& c, double end) {
  return positive_on(c.data(), static_cast<int>(c.size()) - 1, end);
}

TEST(RadialProfile, PositivityOfPolynomialsWithKnownRoots) {
  // (s − 1)(s − 2) = 2 − 3s + s²
  EXPECT_TRUE(positive({2, -3, 1}, 0.999999));
  EXPECT_FALSE(positive({2, -3, 1}, 1.0));
  EXPECT_FALSE(positive({2, -3, 1}, 1.5));
  EXPECT_FALSE(positive({2, -3, 1}, 5.0));  // positive at the end, not between
  // (s − 1)² + 1e-6 stays just above zero; (s − 1)² touches it.
  EXPECT_TRUE(positive({1 + 1e-6, -2, 1}, 3.0));
  EXPECT_FALSE(positive({1, -2, 1}, 3.0));
  EXPECT_TRUE(positive({1}, 1e30));
  EXPECT_FALSE(positive({0, 1}, 1.0));
  EXPECT_FALSE(positive({std::numeric_limits<double>::quiet_NaN(), 1}, 1.0));
  EXPECT_FALSE(positive({1, std::numeric_limits<double>::infinity()}, 1.0));
}

TEST(RadialProfile, PositivityAgreesWithDenseSampling) {
  Random random(4);
  int negative = 0;
  for (int round = 0; round < 2000; ++round) {
    std::vector<double> c{1.0};
    for (int i = 0; i < 8; ++i) c.push_back(random.normal(0.0, 2.0));
    const double end = random.uniform(0.1, 1.5);
    double lowest = 1.0;
    for (int i = 0; i <= 2000; ++i) {
      double value = 0;
      for (int k = 8; k >= 0; --k)
        value = value * (end * i / 2000) + c[static_cast<std::size_t>(k)];
      lowest = std::min(lowest, value);
    }
    if (std::abs(lowest) < 1e-4) continue;  // between samples anything may happen
    EXPECT_EQ(positive(c, end), lowest > 0) << round;
    negative += lowest < 0 ? 1 : 0;
  }
  EXPECT_GT(negative, 300);
}

Camera random_camera(Random& random) {
  Camera camera;
  const int model = static_cast<int>(random.below(3));
  camera.model = static_cast<DistortionModel>(model);
  for (int i = 0; i < camera.distortion_count(); ++i) camera.distortion[i] = random.normal(0, 0.3);
  return camera;
}

TEST(RadialProfile, InverseReturnsToTheRadiusOrStopsAtTheEdge) {
  Random random(5);
  for (int round = 0; round < 500; ++round) {
    const RadialProfile profile(random_camera(random));
    for (const double u : {1e-6, 0.1, 0.4, 0.7, 1.0, 1.5, 3.0}) {
      if (!profile.images(u)) continue;
      const double back = profile.undistorted(profile.distorted(u));
      EXPECT_NEAR(profile.distorted(back), profile.distorted(u),
                  1e-13 * (1 + profile.distorted(u)));
    }
    const double edge = profile.undistorted(1e9);
    EXPECT_TRUE(profile.images(edge));
    // Where g has a finite edge, nothing is imaged beyond it.
    if (profile.distorted(edge) < 1e8) {
      EXPECT_FALSE(profile.images(edge * (1 + 1e-6) + 1e-9));
    }
  }
}

TEST(RadialProfile, SlopeIsTheDerivativeOfTheRatio) {
  Random random(6);
  for (int round = 0; round < 200; ++round) {
    const RadialProfile profile(random_camera(random));
    const double s = random.uniform(0.01, 0.3);
    const double h = 1e-6;
    const double numeric = (profile.ratio(s + h).value - profile.ratio(s - h).value) / (2 * h);
    EXPECT_NEAR(profile.ratio(s).derivative, numeric, 1e-6 * (1 + std::abs(numeric)));
  }
}

}  // namespace
}  // namespace lvcalib
