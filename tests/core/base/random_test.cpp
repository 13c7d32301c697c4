// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/random.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "base/statistics.h"

namespace lvcalib {
namespace {

TEST(Random, SameSeedSameNumbersOtherSeedOrStreamOthers) {
  Random a(42);
  Random b(42);
  Random other_seed(43);
  Random other_stream(42, 1);
  int equal_seed = 0;
  int equal_stream = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::uint32_t bits = a.bits();
    EXPECT_EQ(bits, b.bits());
    equal_seed += bits == other_seed.bits() ? 1 : 0;
    equal_stream += bits == other_stream.bits() ? 1 : 0;
  }
  EXPECT_LE(equal_seed, 1);
  EXPECT_LE(equal_stream, 1);
}

// The generator's authors publish the output of their demonstration program for seed 42,
// stream 54.
TEST(Random, IsThePublishedGenerator) {
  Random random(42, 54);
  for (const std::uint32_t expected :
       {0xa15c02b7U, 0x7b47f409U, 0xba1d3330U, 0x83d2f293U, 0xbfa4784bU, 0xcbed606eU}) {
    EXPECT_EQ(random.bits(), expected);
  }
}

TEST(Random, UniformIsUniform) {
  Random random(1);
  constexpr int kCount = 100'000;
  std::array<int, 10> bins{};
  for (int i = 0; i < kCount; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++bins[static_cast<std::size_t>(10 * u)];
  }
  double chi_square = 0;
  for (const int n : bins) chi_square += std::pow(n - kCount / 10, 2) / (kCount / 10.0);
  EXPECT_LT(chi_square, chi_square_gate(9, 1e-4));
  for (int i = 0; i < 1000; ++i) {
    const double u = random.uniform(-3.0, 5.0);
    EXPECT_TRUE(u >= -3.0 && u < 5.0);
  }
}

TEST(Random, BelowHitsEveryValueAndNoOther) {
  Random random(2);
  std::array<int, 6> seen{};
  for (int i = 0; i < 6000; ++i) {
    const std::uint32_t n = random.below(6);
    ASSERT_LT(n, 6U);
    ++seen[n];
  }
  for (const int n : seen) EXPECT_NEAR(n, 1000, 150);
  EXPECT_EQ(random.below(1), 0U);
}

TEST(Random, NormalHasTheMomentsOfANormal) {
  Random random(3);
  constexpr int kCount = 200'000;
  double m1 = 0;
  double m2 = 0;
  double m4 = 0;
  int beyond_two = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.normal();
    m1 += x;
    m2 += x * x;
    m4 += x * x * x * x;
    beyond_two += std::abs(x) > 2 ? 1 : 0;
  }
  const double n = kCount;
  EXPECT_NEAR(m1 / n, 0.0, 5 / std::sqrt(n));
  EXPECT_NEAR(m2 / n, 1.0, 5 * std::sqrt(2 / n));
  EXPECT_NEAR(m4 / n, 3.0, 5 * std::sqrt(96 / n));
  EXPECT_NEAR(beyond_two / n, 2 * normal_cdf(-2), 0.002);
  double sum = 0;
  for (int i = 0; i < 10'000; ++i) sum += random.normal(7.0, 0.5);
  EXPECT_NEAR(sum / 10'000, 7.0, 0.025);
}

}  // namespace
}  // namespace lvcalib
