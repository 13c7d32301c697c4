// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/discovery.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "selection/effect_search.h"
#include "selection/findings.h"
#include "selection/model_growth.h"
#include "support/pose_matchers.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The product's own search; what it has selected, in order.
std::vector<Selection> grow(EffectSearch& search, const DiscoveryOptions& options) {
  std::vector<Selection> selections;
  grow_model(search, selections, options, {}, [] {});
  return selections;
}

std::vector<std::string> ids_of(const std::vector<Selection>& selections) {
  std::vector<std::string> out;
  for (const Selection& s : selections) out.push_back(s.id);
  return out;
}

const EffectFinding& finding(const std::vector<EffectFinding>& all, const std::string& id) {
  const auto at =
      std::find_if(all.begin(), all.end(), [&](const EffectFinding& f) { return f.id == id; });
  EXPECT_NE(at, all.end()) << id;
  return *at;
}

class Search : public ::testing::Test {
 protected:
  DiscoveryOptions options_;
  RunContext context_;
};

TEST_F(Search, NothingHiddenSelectsNothing) {
  int selected = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    test::TableRecipe recipe;
    recipe.seed = seed;
    const auto made = test::synthetic_table(recipe);
    EffectSearch search(made.table, made.truth, options_, context_);
    selected += grow(search, options_).empty() ? 0 : 1;
  }
  EXPECT_EQ(selected, 0);
}

TEST_F(Search, TwoEffectsAreFoundAndTheExtrinsicIsMended) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.008 * beam.darkness; };
  wrong.corner_px = [](const CornerRow& row) -> Eigen::Vector2d {
    return 0.3 * row.from_tag_px.normalized();
  };
  const auto made = test::synthetic_table({}, wrong);
  EffectSearch search(made.table, made.truth, options_, context_);
  const double before =
      translation_distance_m(search.state().camera_from_lidar, made.truth.camera_from_lidar);
  const auto selections = grow(search, options_);
  EXPECT_THAT(ids_of(selections), ::testing::UnorderedElementsAre("range_walk", "corner_bias"));
  const auto findings = judge_effects(search, selections, options_);
  const EffectFinding& walk = finding(findings, "range_walk");
  EXPECT_EQ(walk.verdict, EffectVerdict::kPresent);
  EXPECT_NEAR(walk.parameters[0].value, 0.008, 3.0 * walk.parameters[0].sigma);
  EXPECT_THAT(walk.explanation, HasSubstr("mm"));
  const EffectFinding& bias = finding(findings, "corner_bias");
  EXPECT_NEAR(bias.parameters[0].value, 0.3, 3.0 * bias.parameters[0].sigma);
  EXPECT_LT(translation_distance_m(search.state().camera_from_lidar, made.truth.camera_from_lidar),
            before);
}

TEST_F(Search, VerdictsOnWhatIsNotThere) {
  const auto made = test::synthetic_table({});
  EffectSearch search(made.table, made.truth, options_, context_);
  ASSERT_THAT(grow(search, options_), IsEmpty());
  const auto findings = judge_effects(search, {}, options_);
  EXPECT_EQ(findings.size(), effect_catalogue().size());
  EXPECT_EQ(finding(findings, "range_walk").verdict, EffectVerdict::kAbsent);
  EXPECT_EQ(finding(findings, "board_bow").verdict, EffectVerdict::kAbsent);
  const EffectFinding& zero = finding(findings, "angle_zero");
  EXPECT_EQ(zero.verdict, EffectVerdict::kNotTestable);
  EXPECT_THAT(zero.explanation, HasSubstr("not defined"));
  for (std::size_t k = 0; k < findings.size(); ++k)
    EXPECT_EQ(findings[k].rank, static_cast<int>(k) + 1);
}

TEST_F(Search, MissingFieldsAreNotTestableAndSaySo) {
  test::TableRecipe recipe;
  recipe.time = recipe.lines = false;
  const auto made = test::synthetic_table(recipe);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  const auto findings = judge_effects(search, {}, options_);
  EXPECT_THAT(finding(findings, "scan_motion").explanation,
              HasSubstr("the time is not in every cloud"));
  EXPECT_THAT(finding(findings, "channel_range_offset").explanation,
              HasSubstr("the laser line is not in every cloud"));
  EXPECT_EQ(finding(findings, "encoder_lag").verdict, EffectVerdict::kNotTestable);
}

TEST_F(Search, EffectsWithOnePatternAreAliased) {
  // Print growth and a boundary bias are the same where tags do not show it.
  test::Disturbance wrong;
  wrong.edge_m = [](const BoundaryRow&) { return 0.001; };
  const auto made = test::synthetic_table({}, wrong);
  EffectSearch search(made.table, made.truth, options_, context_);
  const auto selections = grow(search, options_);
  ASSERT_EQ(selections.size(), 1U);
  EXPECT_FALSE(selections[0].aliases.empty());
  std::vector<std::string> group = selections[0].aliases;
  group.push_back(selections[0].id);
  EXPECT_THAT(group, ::testing::IsSupersetOf({"boundary_bias", "ink_gain"}));
  const auto findings = judge_effects(search, selections, options_);
  EXPECT_EQ(finding(findings, selections[0].id).verdict, EffectVerdict::kAliased);
}

TEST_F(Search, AbsorbedEffectsAreNeverCalledAbsent) {
  // All boards alike and square to the beam: a range offset hides in the extrinsic.
  auto made = test::synthetic_table({});
  const Rigid3 alike = test::facing_board(made.table.target, {0.0, 0.0, 3.0}, {0.0, 0.0, 0.0});
  test::TableRecipe recipe;
  made.table.range.clear();
  made.table.intensity.clear();
  made.table.boundary.clear();
  made.table.corner.clear();
  Random random(3);
  const SceneGeometry geometry(made.truth.camera_from_lidar, alike);
  for (int s = 0; s < recipe.scenes; ++s) {
    made.truth.camera_from_board[static_cast<std::size_t>(s)] = alike;
    for (int k = 0; k < 800; ++k) {
      RangeRow row;
      row.beam = test::table_beam(geometry, s, {random.uniform(0.0, 0.7), random.uniform(0.0, 0.7)},
                                  recipe, random);
      row.sigma_m = 0.008;
      row.measured_m = row.beam.range_m + 0.008 * random.normal();
      made.table.range.push_back(row);
    }
    for (const auto& c :
         test::observed_corners(made.table.target, made.table.camera, alike, 0.05, random)) {
      CornerRow row;
      row.scene = s;
      row.feature = c.feature_id;
      row.corner = c.corner;
      row.board_m = c.board_m;
      row.pixel = c.pixel;
      row.sigma_px = 0.05;
      made.table.corner.push_back(row);
    }
  }
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  const EffectFinding f = finding(judge_effects(search, {}, options_), "range_offset");
  EXPECT_EQ(f.verdict, EffectVerdict::kNotTestable);
  EXPECT_GT(f.extrinsic_move_mm, 1.0);
}

TEST_F(Search, SameInputSameAnswer) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.008 * beam.darkness; };
  const auto made = test::synthetic_table({}, wrong);
  RunContext one;
  one.threads = 1;
  EffectSearch a(made.table, made.truth, options_, one);
  EffectSearch b(made.table, made.truth, options_, context_);
  EXPECT_EQ(ids_of(grow(a, options_)), ids_of(grow(b, options_)));
  EXPECT_EQ(a.state().camera_from_lidar.matrix(), b.state().camera_from_lidar.matrix());
}

TEST_F(Search, ReplacingIsRemovingAndAdding) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.008 * beam.darkness; };
  const auto made = test::synthetic_table({}, wrong);
  EffectSearch a(made.table, made.truth, options_, context_);
  a.add(find_effect("range_scale"), 0.0);
  EffectSearch b(a);
  const auto swap = a.swaps(0, {find_effect("range_walk")}).at(0);
  a.replace(0, swap);
  b.remove(0);
  b.add(find_effect("range_walk"), swap.shape);
  ASSERT_EQ(a.in_use().size(), 1U);
  EXPECT_EQ(a.in_use()[0].effect->info().id, "range_walk");
  EXPECT_NEAR(a.in_use()[0].values(0), b.in_use()[0].values(0), 1e-5);
  EXPECT_LT(translation_distance_m(a.state().camera_from_lidar, b.state().camera_from_lidar), 1e-5);
}

// Range error over azimuth that no effect of the catalogue has.
test::Disturbance ripple() {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.008 * std::sin(25.0 * beam.azimuth_rad); };
  return wrong;
}

TEST(Discover, UnknownStructureIsNamedWithACurveAndAFormulaThatTakeItOut) {
  const auto made = test::synthetic_table({}, ripple());
  DiscoveryOptions options;
  options.max_effects = 3;
  const auto first = discover_effects(made.table, made.truth, options, {});
  ASSERT_TRUE(first.ok()) << first.error().text();
  ASSERT_FALSE(first->unknown.empty());
  EXPECT_EQ(first->unknown[0].channel, Channel::kRange);
  EXPECT_EQ(first->unknown[0].covariate, "azimuth");
  EXPECT_THAT(first->unknown[0].formula, HasSubstr("formula:range:"));
  EXPECT_THAT(first->advice, ::testing::Contains(HasSubstr("--with curve:range:azimuth")));
  for (const std::string& wanted :
       {std::string("curve:range:azimuth"), first->unknown[0].formula}) {
    options.with = {wanted};
    const auto second = discover_effects(made.table, made.truth, options, {});
    ASSERT_TRUE(second.ok()) << second.error().text();
    EXPECT_TRUE(second->holds(wanted));
    for (const StructureScore& s : second->unknown) {
      EXPECT_FALSE(s.channel == Channel::kRange && s.covariate == "azimuth")
          << "left with " << wanted << ": " << s.score;
    }
    EXPECT_GT(second->covariance_with_budget.trace(), second->covariance.trace());
  }
}

TEST(Discover, TooFewScenesAreRefusedInWords) {
  const auto result = discover_effects({}, {}, {});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::kUntrusted);
  EXPECT_THAT(result.error().text(), HasSubstr("three or more"));
}

}  // namespace
}  // namespace lvcalib
