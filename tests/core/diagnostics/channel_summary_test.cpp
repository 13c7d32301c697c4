// SPDX-License-Identifier: GPL-3.0-or-later
#include "diagnostics/channel_summary.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "selection/effect_search.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

const ChannelSummary& of(const std::vector<ChannelSummary>& all, Channel channel) {
  const auto at = std::find_if(all.begin(), all.end(),
                               [&](const ChannelSummary& c) { return c.channel == channel; });
  EXPECT_NE(at, all.end());
  return *at;
}

class Summary : public ::testing::Test {
 protected:
  std::vector<ChannelSummary> summary(const test::SyntheticTable& made) {
    EffectSearch search(made.table, made.truth, options_, context_);
    return summarize_channels(every_residual(made.table, search.state(), search.in_use(), context_),
                              search.in_use(), search.reference().heldout);
  }
  DiscoveryOptions options_;
  RunContext context_;
};

TEST_F(Summary, OfPureNoiseIsTheFloorInEveryChannel) {
  test::TableRecipe recipe;
  recipe.seed = 2;
  const auto all = summary(test::synthetic_table(recipe));
  ASSERT_EQ(all.size(), 4U);
  // Display units: px, mm, mm, 1.
  const double floor[] = {0.05, 8.0, 0.5, 0.2};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(all[k].noise_floor, floor[k], 1e-9);
    EXPECT_NEAR(all[k].rms, floor[k], 0.05 * floor[k]);
    EXPECT_NEAR(all[k].heldout_rms, floor[k], 0.1 * floor[k]);
    EXPECT_LT(all[k].unexplained, 0.3 * floor[k]);
  }
  EXPECT_EQ(of(all, Channel::kRange).n, 6U * 1500U);
  EXPECT_EQ(of(all, Channel::kCorner).n, 6U * 128U);
}

TEST_F(Summary, UnexplainedIsWhatStandsAboveTheFloor) {
  test::Disturbance wrong;
  // 6 mm RMS, too short for any pose to follow.
  wrong.range_m = [](const BeamPoint& beam) {
    return 0.006 * std::sqrt(2.0) * std::sin(200.0 * beam.board_m.x());
  };
  const ChannelSummary range = of(summary(test::synthetic_table({}, wrong)), Channel::kRange);
  EXPECT_NEAR(range.unexplained, 6.0, 0.4);
  EXPECT_NEAR(range.rms, 10.0, 0.3);
  EXPECT_NEAR(range.heldout_rms, 10.0, 0.5);
  EXPECT_NEAR(range.noise_floor, 8.0, 1e-9);
}

TEST_F(Summary, ChannelsThatATargetLacksAreNotThere) {
  auto made = test::synthetic_table({});
  made.table.boundary.clear();
  made.table.intensity.clear();
  const auto all = summary(made);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].channel, Channel::kCorner);
  EXPECT_EQ(all[1].channel, Channel::kRange);
}

}  // namespace
}  // namespace lvcalib
