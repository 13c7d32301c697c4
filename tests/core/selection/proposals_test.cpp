// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/proposals.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;

ModelRanking ranking(const test::Disturbance& wrong, const std::vector<std::string>& add = {},
                     std::uint64_t seed = 1) {
  test::TableRecipe recipe;
  recipe.seed = seed;
  auto made = test::synthetic_table(recipe, wrong);
  auto step = start_model(made.table, made.truth, {}, {});
  EXPECT_TRUE(step);
  for (const std::string& spec : add) {
    step = add_effect(*step, spec, std::nullopt, {});
    EXPECT_TRUE(step);
  }
  auto out = rank_effects(**step, {});
  EXPECT_TRUE(out);
  return *out;
}

const EffectProposal& proposal(const ModelRanking& ranking, const std::string& id) {
  const auto at = std::find_if(ranking.proposals.begin(), ranking.proposals.end(),
                               [&](const EffectProposal& p) { return p.finding.id == id; });
  EXPECT_NE(at, ranking.proposals.end()) << id;
  return *at;
}

TEST(Proposals, WhatIsHiddenComesFirstWithItsSizeAndWhatItGains) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.008 * beam.darkness; };
  const ModelRanking r = ranking(wrong);
  ASSERT_FALSE(r.proposals.empty());
  const EffectProposal& top = r.proposals.front();
  EXPECT_EQ(top.finding.id, "range_walk");
  EXPECT_TRUE(top.suggested);
  EXPECT_EQ(top.finding.rank, 1);
  EXPECT_NE(top.finding.verdict, EffectVerdict::kAbsent);
  EXPECT_FALSE(r.nothing_missing());
  EXPECT_TRUE(r.unknown.empty()) << "a known effect explains it";
  const ParameterEstimate& a = top.finding.parameters.front();
  EXPECT_NEAR(a.value, 0.008, 4.0 * a.sigma);
  // Half of the rows are dark: (8 mm/2)² beside a noise of (8 mm)² is a fifth of the squares.
  EXPECT_NEAR(top.heldout_fall[static_cast<std::size_t>(Channel::kRange)], 0.2, 0.06);
  EXPECT_THAT(top.finding.explanation, HasSubstr("range channel"));
  EXPECT_GE(top.gained_mm, 0.0);
}

// The extrinsic that is stated has moved towards the effect already where the joint solve put it
// down to an error of the sensor on black print.
TEST(Proposals, WhatAddingMovesIsToldFromTheExtrinsicThatIsStated) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.008 * beam.darkness; };
  auto made = test::synthetic_table({}, wrong);
  constexpr double kNone = 1e-14;
  made.table.sensor_variances = {kNone, 0.008 * 0.008, kNone};
  const auto base = start_model(made.table, made.truth, {}, {});
  ASSERT_TRUE(base);
  const auto ranked = rank_effects(**base, {});
  ASSERT_TRUE(ranked);
  const auto added = add_effect(*base, "range_walk", std::nullopt, {});
  ASSERT_TRUE(added);
  const auto moved_mm = [&](const Rigid3& from) {
    const Rigid3& to = (*added)->state.camera_from_lidar;
    return 1e3 * (to.translation - from.translation).norm();
  };
  const double stated = moved_mm((*base)->state.camera_from_lidar);
  const double searched = moved_mm((*base)->search->state().camera_from_lidar);
  // Else nothing would be tested here.
  ASSERT_GT(searched, 2.0 * stated + 0.2);
  // The ranking goes by the weights of the search, the step by those of what is stated.
  EXPECT_NEAR(proposal(*ranked, "range_walk").gained_mm, stated, 0.5 * (searched - stated))
      << searched;
}

TEST(Proposals, NothingHiddenSuggestsNothingAndSaysSo) {
  const ModelRanking r = ranking({});
  EXPECT_TRUE(r.nothing_missing());
  EXPECT_FALSE(r.proposals.empty()) << "everything is judged all the same";
  EXPECT_EQ(proposal(r, "range_walk").finding.verdict, EffectVerdict::kAbsent);
  EXPECT_TRUE(std::none_of(r.proposals.begin(), r.proposals.end(), [](const EffectProposal& p) {
    return p.finding.verdict == EffectVerdict::kPresent;
  }));
}

TEST(Proposals, EffectsInUseAreNotProposedAgain) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.008 * beam.darkness; };
  const ModelRanking r = ranking(wrong, {"range_walk"});
  EXPECT_TRUE(std::none_of(r.proposals.begin(), r.proposals.end(),
                           [](const EffectProposal& p) { return p.finding.id == "range_walk"; }));
  EXPECT_TRUE(r.nothing_missing());
}

TEST(Proposals, AliasesStandBehindTheOneThatTheyCannotBeToldFrom) {
  // Every edge moves out: the ink, or a bias of the boundary. Both explain it the same.
  test::Disturbance wrong;
  wrong.edge_m = [](const BoundaryRow&) { return 0.002; };
  const ModelRanking r = ranking(wrong);
  const auto suggested =
      std::count_if(r.proposals.begin(), r.proposals.end(),
                    [](const EffectProposal& p) { return p.suggested && p.alias_of.empty(); });
  EXPECT_GE(suggested, 1);
  const EffectProposal& top = r.proposals.front();
  ASSERT_TRUE(top.suggested);
  for (std::size_t k = 1; k <= top.finding.aliases.size(); ++k) {
    EXPECT_EQ(r.proposals[k].alias_of, top.finding.id);
    EXPECT_EQ(r.proposals[k].finding.verdict, EffectVerdict::kAliased);
  }
  if (!top.finding.aliases.empty()) {
    EXPECT_EQ(top.finding.verdict, EffectVerdict::kAliased);
    EXPECT_THAT(top.finding.explanation, HasSubstr("to tell"));
  }
  EXPECT_TRUE(top.finding.id == "boundary_bias" || top.finding.id == "ink_gain" ||
              top.finding.id == "blooming")
      << top.finding.id;
}

TEST(Proposals, StructureThatNoEffectExplainsIsUnknown) {
  // A wave along the board that no effect of the catalogue has.
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) {
    return 0.008 * std::copysign(1.0, std::sin(40.0 * beam.board_m.x()));
  };
  const ModelRanking r = ranking(wrong);
  EXPECT_FALSE(r.nothing_missing());
  const bool named = std::any_of(r.unknown.begin(), r.unknown.end(), [](const StructureScore& s) {
    return s.channel == Channel::kRange && s.covariate == "board x";
  });
  const bool suggested = std::any_of(r.proposals.begin(), r.proposals.end(),
                                     [](const EffectProposal& p) { return p.suggested; });
  EXPECT_TRUE(named || suggested);
  EXPECT_TRUE(named) << "the covariate is named";
}

TEST(Proposals, ASessionReadsAsADiscovery) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.008 * beam.darkness; };
  auto made = test::synthetic_table({}, wrong);
  const auto base = start_model(made.table, made.truth, {}, {});
  const auto step = add_effect(*base, "range_walk", 0.0, {});
  ASSERT_TRUE(step);
  const auto missing = rank_effects(**step, {});
  ASSERT_TRUE(missing);
  const Discovery d = as_discovery({*base, *step}, &*missing);
  EXPECT_TRUE(d.holds("range_walk"));
  ASSERT_EQ(d.history.size(), 2U);
  EXPECT_EQ(d.history[0].added, "");
  EXPECT_EQ(d.history[1].added, "range_walk");
  ASSERT_GT(d.effects.size(), 10U);
  EXPECT_EQ(d.effects[0].id, "range_walk");
  EXPECT_EQ(d.effects[0].rank, 1);
  EXPECT_GT(d.effects[0].parameters.at(0).sigma, 0.0);
  EXPECT_EQ(d.model.size(), 1U);
  EXPECT_EQ(d.covariance, (*step)->covariance);
  EXPECT_TRUE(as_discovery({}, nullptr).history.empty());
}

TEST(Proposals, AStoppedRankingSaysSo) {
  auto made = test::synthetic_table({});
  const auto step = start_model(made.table, made.truth, {}, {});
  ASSERT_TRUE(step);
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  EXPECT_EQ(rank_effects(**step, context).error().kind, ErrorKind::kCancelled);
}

}  // namespace
}  // namespace lvcalib
