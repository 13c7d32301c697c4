// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/paired_moments.h"

#include <gtest/gtest.h>

namespace lvcalib {
namespace {

TEST(PairedMoments, GiveTheRegressionOfAnExactLine) {
  PairedMoments m;
  for (const double x : {0.0, 1.0, 2.5, 4.0}) m.add(x, 7.0 - 2.0 * x);
  EXPECT_NEAR(m.slope(), -2.0, 1e-12);
  EXPECT_NEAR(m.correlation(), -1.0, 1e-12);
  EXPECT_NEAR(m.y_squares(), 4.0 * m.x_squares(), 1e-9);
}

// By hand: x̄ = 2, ȳ = 3, Σ(x−x̄)² = 2, Σ(y−ȳ)² = 14, Σ(x−x̄)(y−ȳ) = 5.
TEST(PairedMoments, GiveTheCorrelationOfThreePairs) {
  PairedMoments m;
  m.add(1.0, 1.0);
  m.add(2.0, 2.0);
  m.add(3.0, 6.0);
  EXPECT_NEAR(m.correlation(), 5.0 / std::sqrt(28.0), 1e-12);
  EXPECT_NEAR(m.slope(), 2.5, 1e-12);
}

TEST(PairedMoments, WhatDoesNotVaryCorrelatesWithNothing) {
  PairedMoments m;
  EXPECT_EQ(m.correlation(), 0.0);
  for (const double y : {1.0, 2.0, 3.0}) m.add(4.0, y);
  EXPECT_EQ(m.correlation(), 0.0);
  EXPECT_EQ(m.slope(), 0.0);
}

}  // namespace
}  // namespace lvcalib
