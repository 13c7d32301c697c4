// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/model_growth.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

double walk_by_darkness(const BeamPoint& beam) {
  return 0.008 * beam.darkness;
}

// Ranges that follow the power that range and incidence leave.
double walk_by_power(const BeamPoint& beam) {
  const double log_power =
      std::log(std::cos(beam.incidence_rad)) - 2.0 * std::log(beam.range_m / 3.0);
  return 0.02 * (beam.darkness - log_power / std::log(10.0));
}

class Growing : public ::testing::Test {
 protected:
  Growing() {
    test::Disturbance wrong;
    wrong.range_m = walk_by_darkness;
    wrong.corner_px = [](const CornerRow& row) {
      return Eigen::Vector2d(0.15 * row.from_tag_px.normalized());
    };
    made_ = test::synthetic_table({}, wrong);
  }
  [[nodiscard]] std::vector<std::string> ids(const EffectSearch& search) const {
    std::vector<std::string> out;
    for (const EffectInUse& use : search.in_use()) out.push_back(use.effect->info().id);
    return out;
  }
  [[nodiscard]] std::vector<std::string> ids() const {
    std::vector<std::string> out;
    for (const Selection& s : selections_) out.push_back(s.id);
    return out;
  }
  // Rows made again: with a range walk in use its law in them is another.
  [[nodiscard]] auto with_walk_made_again(double (*law)(const BeamPoint&)) const {
    return [given = made_.table, law](const ModelState&, const std::vector<EffectInUse>& in_use,
                                      const RunContext&) {
      MeasurementTable out = given;
      const bool walks = std::any_of(in_use.begin(), in_use.end(), [](const EffectInUse& use) {
        return use.effect->info().id == "range_walk";
      });
      for (RangeRow& row : out.range) {
        if (walks) row.measured_m += law(row.beam) - walk_by_darkness(row.beam);
      }
      return out;
    };
  }
  test::SyntheticTable made_;
  DiscoveryOptions options_;
  RunContext context_;
  std::vector<Selection> selections_;
};

TEST_F(Growing, AddsWhatIsThereAndKeepsTheListsInStep) {
  EffectSearch search(made_.table, made_.truth, options_, context_);
  std::size_t rounds = 0;
  grow_model(search, selections_, options_, context_, [&] {
    ++rounds;
    EXPECT_EQ(ids(), ids(search));
  });
  EXPECT_EQ(rounds, 2U);
  EXPECT_THAT(ids(), ::testing::UnorderedElementsAre("range_walk", "corner_bias"));
  EXPECT_FALSE(search.best().has_value());
}

TEST_F(Growing, TheUsersOwnStayHoweverUseless) {
  EffectSearch search(made_.table, made_.truth, options_, context_);
  search.add(find_effect("range_cyclic"), 0.3);
  selections_.emplace_back();
  selections_.back().id = "range_cyclic";
  selections_.back().wanted = true;
  options_.max_effects = 1;  // beside the user's
  grow_model(search, selections_, options_, context_, [] {});
  ASSERT_EQ(selections_.size(), 2U);
  EXPECT_EQ(selections_[0].id, "range_cyclic");
  EXPECT_EQ(ids(), ids(search));
}

// Effects that seem right on the rows at hand, with which the table made again has rows that they
// predict far worse: the model goes back to where it was and says that scenes contradict them.
TEST_F(Growing, WhatPredictsTheRowsThatItChoosesWorseIsTakenBack) {
  const MeasurementTable given = made_.table;
  made_.table.again = [given](const ModelState&, const std::vector<EffectInUse>& in_use,
                              const RunContext&) {
    MeasurementTable out = given;
    const bool wrong = std::any_of(in_use.begin(), in_use.end(), [](const EffectInUse& use) {
      return use.effect->info().id != "corner_bias";
    });
    if (!wrong) return out;
    for (RangeRow& row : out.range)
      row.measured_m += (row.beam.scene % 2 == 0 ? 0.03 : -0.03) * row.beam.board_m.x();
    return out;
  };
  EffectSearch search(made_.table, made_.truth, options_, context_);
  const Rigid3 before = search.state().camera_from_lidar;
  std::vector<std::vector<std::string>> rounds;
  grow_model(search, selections_, options_, context_, [&] { rounds.push_back(ids()); });
  EXPECT_THAT(ids(), ::testing::ElementsAre("corner_bias"));
  EXPECT_EQ(ids(), ids(search));
  ASSERT_EQ(rounds.size(), 1U);
  EXPECT_THAT(rounds[0], ::testing::ElementsAre("corner_bias"));
  EXPECT_LT(translation_distance_m(search.state().camera_from_lidar, before), 0.002);
  for (const Candidate& c : search.candidates()) {
    if (search.linear().columns.list()[c.columns].effect->info().id != "range_walk") continue;
    EXPECT_EQ(c.contradiction, Contradiction::kScenes);
  }
}

// An effect that the rows at hand show and those made with it do not: nothing is left of it.
TEST_F(Growing, WhatComesToNothingAmongItsOwnRowsIsTakenBack) {
  made_.table.again = with_walk_made_again([](const BeamPoint&) { return 0.0; });
  options_.max_effects = 1;
  EffectSearch search(made_.table, made_.truth, options_, context_);
  grow_model(search, selections_, options_, context_, [&] { EXPECT_EQ(ids(), ids(search)); });
  EXPECT_THAT(ids(), ::testing::ElementsAre("corner_bias"));
  EXPECT_EQ(ids(), ids(search));
}

// Ranges of the rows made with it follow the power that range and incidence leave as well: another
// shape, and not a neighbour of that which the rows before show.
TEST_F(Growing, AShapeIsChosenAnewAmongItsOwnRows) {
  made_.table.again = with_walk_made_again(walk_by_power);
  options_.max_effects = 1;  // What comes in later asks for shapes again.
  EffectSearch search(made_.table, made_.truth, options_, context_);
  grow_model(search, selections_, options_, context_, [] {});
  ASSERT_THAT(ids(), ::testing::ElementsAre("range_walk"));
  EXPECT_NEAR(search.in_use()[0].shape, 2.0, 0.1);
  EXPECT_NEAR(search.in_use()[0].values(0), 0.02, 0.002);
}

TEST_F(Growing, AStoppedSearchAddsNothing) {
  std::stop_source stop;
  context_.stop = stop.get_token();
  EffectSearch search(made_.table, made_.truth, options_, context_);
  stop.request_stop();
  grow_model(search, selections_, options_, context_, [] { FAIL(); });
  EXPECT_TRUE(selections_.empty());
}

// On the grid of the search are decays over 1.2 and 2.4 m: what the nearest leaves over must not be
// taken for further effects.
TEST_F(Growing, AShapeBetweenTheOnesTriedLeavesNothingOver) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.08 * std::exp(-beam.range_m / 1.7); };
  test::TableRecipe recipe;
  recipe.range_rows = 4000;
  made_ = test::synthetic_table(recipe, wrong);
  EffectSearch search(made_.table, made_.truth, options_, context_);
  grow_model(search, selections_, options_, context_, [] {});
  EXPECT_THAT(ids(), ::testing::ElementsAre("range_near"));
  ASSERT_FALSE(search.in_use().empty());
  EXPECT_NEAR(search.in_use()[0].shape, 1.7, 0.15);
}

// A shape that was right while something else was missing: beside what has come in another one, not
// a neighbour of the first, is. Here ranges follow the power that range and incidence leave.
TEST_F(Growing, AShapeIsChosenAnewBesideWhatCameIn) {
  test::Disturbance wrong;
  wrong.range_m = walk_by_power;
  wrong.corner_px = [](const CornerRow& row) {
    return Eigen::Vector2d(0.15 * row.from_tag_px.normalized());
  };
  made_ = test::synthetic_table({}, wrong);
  EffectSearch search(made_.table, made_.truth, options_, context_);
  search.add(find_effect("range_walk"), 0.5);
  selections_.emplace_back();
  selections_.back().id = "range_walk";
  grow_model(search, selections_, options_, context_, [] {});
  EXPECT_THAT(ids(), ::testing::ElementsAre("range_walk", "corner_bias"));
  ASSERT_EQ(ids(), ids(search));
  EXPECT_NEAR(search.in_use()[0].shape, 2.0, 0.1);
  EXPECT_NEAR(search.in_use()[0].values(0), 0.02, 0.002);
}

}  // namespace
}  // namespace lvcalib
