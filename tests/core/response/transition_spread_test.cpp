// SPDX-License-Identifier: GPL-3.0-or-later
#include "response/transition_spread.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace lvcalib {
namespace {

TEST(PlateauLevels, AreMediansBeyondTwoWidths) {
  Random random(1);
  std::vector<std::pair<double, double>> samples;
  for (int k = 0; k < 2000; ++k) {
    const double z = random.uniform(-5.0, 5.0);
    const double level = z < -2 ? 10.0 : (z > 2 ? 100.0 : 55.0);
    samples.emplace_back(z, level + 3.0 * random.normal());
  }
  const auto levels = plateau_levels(samples);
  ASSERT_TRUE(levels.has_value());
  EXPECT_NEAR(levels->in, 10.0, 0.5);
  EXPECT_NEAR(levels->out, 100.0, 0.5);
  EXPECT_NEAR(levels->noise_in, 3.0, 0.5);
  EXPECT_TRUE(levels->stand_clear());
  EXPECT_FALSE(levels->is_stray(10.0));
  EXPECT_FALSE(levels->is_stray(55.0));
  EXPECT_TRUE(levels->is_stray(140.0));
  EXPECT_TRUE(levels->is_stray(-30.0));
  EXPECT_FALSE(plateau_levels({{-3.0, 1.0}, {3.0, 2.0}}).has_value());
}

TEST(TransitionSpread, MeasuresHowMuchLevelsJump) {
  const PlateauLevels levels{0.0, 1.0, 0.05, 0.02};
  for (const double share : {0.0, 0.4, 1.0}) {
    Random random(2);
    TransitionSpread spread;
    spread.clear();
    for (int k = 0; k < 20'000; ++k) {
      const double lambda = random.uniform();
      // A jump of probability `share`: to white with the chance λ.
      const bool jumps = random.uniform() < share;
      const double level = jumps ? (random.uniform() < lambda ? 1.0 : 0.0) : lambda;
      spread.add(lambda, level - lambda + 0.03 * random.normal(), levels);
    }
    spread.finish();
    EXPECT_NEAR(spread.variance(0.5, levels), 0.25 * share + 0.00145, 0.01) << share;
    EXPECT_NEAR(spread.variance(0.0, levels), 0.05 * 0.05, 1e-5) << share;
    EXPECT_NEAR(spread.variance(1.0, levels), 0.02 * 0.02, 1e-5) << share;
  }
}

}  // namespace
}  // namespace lvcalib
