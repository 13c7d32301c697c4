// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/findings.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;

const EffectFinding& finding_of(const std::vector<EffectFinding>& all, const std::string& id) {
  const auto at =
      std::find_if(all.begin(), all.end(), [&](const EffectFinding& f) { return f.id == id; });
  EXPECT_NE(at, all.end()) << id;
  return *at;
}

class Findings : public ::testing::Test {
 protected:
  // Adds the effects, ranks the rest, and judges all.
  std::vector<EffectFinding> judged(const test::SyntheticTable& made,
                                    const std::vector<std::string>& added = {},
                                    const std::vector<std::string>& aliases = {}) {
    EffectSearch search(made.table, made.truth, options_, context_);
    std::vector<Selection> selected;
    for (const std::string& id : added) {
      search.add(find_effect(id), find_effect(id)->shapes(made.table).front());
      Selection s;
      s.id = id;
      s.aliases = aliases;
      selected.push_back(s);
    }
    search.rank();
    return judge_effects(search, selected, options_);
  }
  static test::SyntheticTable with_walk() {
    test::Disturbance wrong;
    wrong.range_m = [](const BeamPoint& beam) { return 0.008 * beam.darkness; };
    return test::synthetic_table({}, wrong);
  }
  DiscoveryOptions options_;
  RunContext context_;
};

TEST_F(Findings, EveryEffectOfTheCatalogueIsJudgedOnceAndRanked) {
  const auto all = judged(with_walk(), {"range_walk"});
  std::set<std::string> ids;
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_EQ(all[k].rank, static_cast<int>(k) + 1);
    EXPECT_TRUE(ids.insert(all[k].id).second) << all[k].id;
    EXPECT_FALSE(all[k].explanation.empty()) << all[k].id;
  }
  for (const EffectPtr& effect : effect_catalogue())
    EXPECT_TRUE(ids.contains(effect->info().id)) << effect->info().id;
  EXPECT_EQ(all.front().id, "range_walk");
}

TEST_F(Findings, PresentTellsValueUncertaintyAndWhatItDoes) {
  const EffectFinding f = finding_of(judged(with_walk(), {"range_walk"}), "range_walk");
  EXPECT_EQ(f.verdict, EffectVerdict::kPresent);
  ASSERT_EQ(f.parameters.size(), 1U);
  EXPECT_NEAR(f.parameters[0].value, 0.008, 3.0 * f.parameters[0].sigma);
  EXPECT_LT(f.parameters[0].sigma, 0.001);
  EXPECT_THAT(f.explanation, ::testing::AllOf(HasSubstr("± "), HasSubstr("mm"), HasSubstr("mrad")));
}

// The table's beam is round.
TEST_F(Findings, WhatTheBaseModelMeasuresOfTheBeamIsTold) {
  const auto all = judged(with_walk());
  const EffectFinding divergence = finding_of(all, "beam_divergence");
  EXPECT_EQ(divergence.verdict, EffectVerdict::kNotTestable);
  ASSERT_EQ(divergence.parameters.size(), 1U);
  const ParameterEstimate& width = divergence.parameters.front();
  EXPECT_GT(width.sigma, 0.0);
  // The table's discs are made with one edge each, the print knows them whole.
  const double truth = test::kTableBeam_rad * test::kTableBeam_rad;
  EXPECT_NEAR(width.value, truth, 0.3 * truth);
  const EffectFinding anisotropy = finding_of(all, "footprint_anisotropy");
  ASSERT_EQ(anisotropy.parameters.size(), 1U);
  EXPECT_NEAR(anisotropy.parameters.front().value, 0.0, 4.0 * anisotropy.parameters.front().sigma);
}

TEST_F(Findings, AliasedNamesTheOthersAndTheSceneThatTells) {
  const EffectFinding f =
      finding_of(judged(with_walk(), {"range_walk"}, {"range_near"}), "range_walk");
  EXPECT_EQ(f.verdict, EffectVerdict::kAliased);
  EXPECT_THAT(f.explanation, HasSubstr("range_near"));
  EXPECT_THAT(f.explanation, HasSubstr(find_effect("range_walk")->info().discriminating_pose));
}

// At the same weights: without an effect its errors make others look larger.
TEST_F(Findings, WhatAnEffectInUseMovesIsWhatSolvingWithoutItMoves) {
  const auto made = with_walk();
  const EffectFinding f = finding_of(judged(made, {"corner_bias", "range_walk"}), "range_walk");
  EffectSearch search(made.table, made.truth, options_, context_);
  for (const char* id : {"corner_bias", "range_walk"})
    search.add(find_effect(id), find_effect(id)->shapes(made.table).front());
  const ModelFit& with = search.reference().fit;
  constexpr std::size_t kWalk = 1;  // Each of the two has one parameter.
  const double step = with.solution(6 + kWalk);
  ColumnSubset pinned = search.reference().subset;
  pinned.prior_sigma[kWalk] = 1e-9;
  pinned.prior_mean[kWalk] = step - search.in_use()[kWalk].values(0);
  const ModelFit without = fit_model(search.linear(), pinned, with.variances, {.rounds = 0});
  const Vector6d moved = without.solution.head<6>() - with.solution.head<6>();
  EXPECT_GT(f.extrinsic_move_mm, 1.0);
  EXPECT_NEAR(f.extrinsic_move_mm, 1e3 * moved.head<3>().norm(), 0.01);
  EXPECT_NEAR(f.extrinsic_move_mrad, 1e3 * moved.tail<3>().norm(), 0.01);
}

// 95 % of what is told absent must move the extrinsic by less than is tolerated, however large its
// parameter may be.
TEST_F(Findings, AbsentIsWhatMovesTheExtrinsicByLessThanIsTolerated) {
  const auto all = judged(test::synthetic_table({}));
  int absent = 0;
  for (const EffectFinding& f : all) {
    if (f.verdict == EffectVerdict::kAbsent) {
      ++absent;
      EXPECT_FALSE(f.matters) << f.id;
    }
  }
  EXPECT_GT(absent, 5);
  // Who tolerates little is told less.
  options_.tolerance = {{1e-7, 1e-7}, 0.0};
  for (const EffectFinding& f : judged(test::synthetic_table({}))) {
    if (f.verdict != EffectVerdict::kAbsent) continue;
    EXPECT_LT(f.extrinsic_move_mm, 1e-4) << f.id;
    EXPECT_LT(f.extrinsic_move_mrad, 1e-4) << f.id;
  }
}

TEST_F(Findings, FewNoisyScenesMakeEffectsNotTestableRatherThanAbsent) {
  test::TableRecipe recipe;
  recipe.scenes = 3;
  recipe.range_rows = 60;
  recipe.range_sigma_m = 0.3;
  const auto all = judged(test::synthetic_table(recipe));
  for (const char* id : {"range_offset", "range_scale", "range_near", "range_incidence"}) {
    const EffectFinding& f = finding_of(all, id);
    EXPECT_EQ(f.verdict, EffectVerdict::kNotTestable) << id;
    EXPECT_THAT(f.explanation, HasSubstr(find_effect(id)->info().discriminating_pose)) << id;
  }
}

TEST_F(Findings, MissingFieldsAreNamed) {
  test::TableRecipe recipe;
  recipe.time = recipe.lines = false;
  const auto all = judged(test::synthetic_table(recipe));
  EXPECT_THAT(finding_of(all, "scan_motion").explanation,
              HasSubstr("the time is not in every cloud"));
  EXPECT_THAT(finding_of(all, "channel_angle_offset").explanation,
              HasSubstr("the laser line is not in every cloud"));
  EXPECT_TRUE(finding_of(all, "scan_motion").parameters.empty());
}

TEST_F(Findings, WhatScenesHeldOutContradictIsNotJudgedPresent) {
  const auto made = with_walk();
  EffectSearch search(made.table, made.truth, options_, context_);
  search.refuse("range_walk");
  search.rank();
  const auto best = search.best();
  if (best) {
    EXPECT_NE(search.linear().columns.list()[search.candidates()[*best].columns].effect->info().id,
              "range_walk");
  }
  const EffectFinding f = finding_of(judge_effects(search, {}, options_), "range_walk");
  EXPECT_NE(f.verdict, EffectVerdict::kPresent);
  EXPECT_THAT(f.explanation, HasSubstr("predicts scenes held out worse"));
  EXPECT_THAT(f.explanation, HasSubstr(find_effect("range_walk")->info().discriminating_pose));
}

TEST_F(Findings, AliasesOfACandidateAreThoseWithItsPattern) {
  test::Disturbance wrong;
  wrong.edge_m = [](const BoundaryRow&) { return 0.001; };
  const auto made = test::synthetic_table({}, wrong);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  const auto best = search.best();
  ASSERT_TRUE(best.has_value());
  const auto aliases = aliases_of(search, *best, options_);
  const std::string id =
      search.linear().columns.list()[search.candidates()[*best].columns].effect->info().id;
  // Every circle of this table has one size and contrast: nothing tells these apart.
  std::vector<std::string> group = aliases;
  group.push_back(id);
  EXPECT_THAT(group, ::testing::IsSupersetOf({"boundary_bias", "ink_gain"}));
  EXPECT_THAT(group, ::testing::Not(::testing::Contains("range_walk")));
}

}  // namespace
}  // namespace lvcalib
