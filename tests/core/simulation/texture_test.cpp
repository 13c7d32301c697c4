// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/texture.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lvcalib::simulation {
namespace {

TEST(Texture, StaysInRangeAndUsesItsContrast) {
  for (const auto kind :
       {Texture::Kind::kClouds, Texture::Kind::kBlocks, Texture::Kind::kStripes}) {
    const Texture texture{kind, 0.5, 0.6, 0.1, 3};
    double low = 1.0;
    double high = 0.0;
    for (int i = -100; i < 100; ++i) {
      const double value = texture.at(0.037 * i, -0.021 * i);
      low = std::min(low, value);
      high = std::max(high, value);
    }
    EXPECT_GE(low, 0.03);
    EXPECT_LE(high, 0.95);
    EXPECT_GT(high - low, 0.3);
  }
}

TEST(Texture, CloudsAreSmoothAlsoAcrossZero) {
  const Texture texture{Texture::Kind::kClouds, 0.5, 0.3, 0.1, 4};
  for (int i = -2000; i < 2000; ++i) {
    const double x = 1e-4 * i;
    ASSERT_LT(std::abs(texture.at(x, x) - texture.at(x + 1e-4, x + 1e-4)), 0.01) << x;
  }
}

TEST(Texture, SeedsDiffer) {
  const Texture a{Texture::Kind::kBlocks, 0.5, 0.4, 0.1, 1};
  Texture b = a;
  b.seed = 2;
  int same = 0;
  for (int i = 0; i < 100; ++i) same += a.at(0.1 * i, 0.0) == b.at(0.1 * i, 0.0) ? 1 : 0;
  EXPECT_LT(same, 10);
}

}  // namespace
}  // namespace lvcalib::simulation
