// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/disturbances/effect_plan.h"

#include <numeric>

#include <gtest/gtest.h>

#include "base/statistics.h"

namespace lvcalib::simulation {
namespace {

TEST(EffectPlan, ConvertsToSi) {
  const std::map<std::string, double> effects = {{"range_offset", 20.0}, {"encoder_lag", 5.0}};
  const EffectPlan plan(effects, 1);
  EXPECT_TRUE(plan.has("range_offset"));
  EXPECT_FALSE(plan.has("range_scale"));
  EXPECT_DOUBLE_EQ(plan.si("range_offset"), 0.020);
  EXPECT_DOUBLE_EQ(plan.si("encoder_lag"), 5e-6);
  EXPECT_DOUBLE_EQ(plan.si("range_scale"), 0.0);
  EXPECT_DOUBLE_EQ(plan.si("boundary_range_pull", 1.0), 1.0);
}

TEST(EffectPlan, EveryEffectHasARandomStreamOfItsOwn) {
  const std::map<std::string, double> effects;
  const EffectPlan plan(effects, 1);
  const double first = plan.random("board_bow").uniform();
  EXPECT_EQ(plan.random("board_bow").uniform(), first);
  EXPECT_NE(plan.random("print_scale").uniform(), first);
  EXPECT_NE(EffectPlan(effects, 2).random("board_bow").uniform(), first);
}

TEST(EffectPlan, LineDeviationsHaveTheRmsAskedForAndNoMean) {
  const std::map<std::string, double> effects = {{"channel_range_offset", 10.0}};
  EffectPlan plan(effects, 3);
  Random random = plan.random("channel_range_offset");
  const auto lines = plan.per_line("channel_range_offset", "line_mm", 0.01, 1e-3, 6, random);
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_NEAR(std::accumulate(lines.begin(), lines.end(), 0.0), 0.0, 1e-15);
  EXPECT_NEAR(rms(lines), 0.01, 1e-12);
  EXPECT_NEAR(plan.details().at("channel_range_offset").at("line_mm")[2], 1e3 * lines[2], 1e-12);
  EXPECT_TRUE(plan.per_line("range_walk", "x", 1.0, 1.0, 6, random).empty());
}

TEST(EffectPlan, NotesOnlyWhatIsPlanted) {
  const std::map<std::string, double> effects = {{"range_walk", 1.0}};
  EffectPlan plan(effects, 1);
  plan.note("range_walk", "pulse_width_mm", 3.0);
  plan.note("range_cyclic", "unit_m", 0.2);
  EXPECT_EQ(plan.details().size(), 1U);
  EXPECT_EQ(plan.details().at("range_walk").at("pulse_width_mm"), std::vector<double>{3.0});
}

}  // namespace
}  // namespace lvcalib::simulation
