// SPDX-License-Identifier: GPL-3.0-or-later
#include "diagnostics/structure_scan.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text.h"
#include "selection/findings.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

using ::testing::ElementsAre;

TEST(StructureScan, FindsNothingInNoise) {
  const auto made = test::synthetic_table({});
  for (const StructureScore& s : scan_structure(made.table, made.truth, {}, {}).curves)
    EXPECT_LT(s.score, 0.02) << name_of(s.channel) << " against " << s.covariate;
}

TEST(StructureScan, NamesChannelAndCovariateOfARipple) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.008 * std::sin(40.0 * beam.azimuth_rad); };
  const auto made = test::synthetic_table({}, wrong);
  const auto scores = scan_structure(made.table, made.truth, {}, {}).curves;
  ASSERT_FALSE(scores.empty());
  EXPECT_EQ(scores.front().channel, Channel::kRange);
  EXPECT_EQ(scores.front().covariate, "azimuth");
  EXPECT_GT(scores.front().score, 0.05);
}

TEST(StructureScan, ScoreIsTheShareOfHeldOutVariance) {
  // 6 mm on black and 0 on white: with half the points black the curve's variance is 9 mm², that
  // of the noise 64 mm².
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.006 * beam.darkness; };
  test::TableRecipe recipe;
  recipe.range_rows = 4000;
  const auto made = test::synthetic_table(recipe, wrong);
  double black = 0.0;
  for (const RangeRow& row : made.table.range) black += row.print == Print::kBlack ? 1.0 : 0.0;
  black /= static_cast<double>(made.table.range.size());
  const double curve = 36.0 * black * (1.0 - black);
  int seen = 0;
  for (const StructureScore& s : scan_structure(made.table, made.truth, {}, {}).curves) {
    if (s.channel != Channel::kRange || s.covariate != "print") continue;
    ++seen;
    EXPECT_NEAR(s.score, curve / (curve + 64.0), 0.02);
    EXPECT_NEAR(s.amplitude, std::sqrt(curve), 0.15 * std::sqrt(curve));
  }
  EXPECT_EQ(seen, 1);
}

// One scene alone cannot make structure: it does not predict the others.
TEST(StructureScan, WhatHoldsInOneSceneOnlyIsNoStructure) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) {
    return beam.scene == 2 ? 0.01 * std::sin(30.0 * beam.board_m.x()) : 0.0;
  };
  const auto made = test::synthetic_table({}, wrong);
  for (const StructureScore& s : scan_structure(made.table, made.truth, {}, {}).curves) {
    if (s.channel != Channel::kRange) continue;
    EXPECT_LT(s.score, 0.02) << s.covariate;
  }
}

TEST(StructureScan, AFineRippleNeedsFineSplines) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.006 * std::sin(90.0 * beam.azimuth_rad); };
  test::TableRecipe recipe;
  recipe.range_rows = 6000;
  const auto made = test::synthetic_table(recipe, wrong);
  const auto scores = scan_structure(made.table, made.truth, {}, {}).curves;
  ASSERT_FALSE(scores.empty());
  EXPECT_EQ(scores.front().channel, Channel::kRange);
  EXPECT_EQ(scores.front().covariate, "azimuth");
  // 18 mm² of 82 mm².
  EXPECT_GT(scores.front().score, 0.15);
}

StructureScore best_of(const std::vector<StructureScore>& scores, const std::string& covariate) {
  StructureScore best;
  for (const StructureScore& s : scores) {
    if (s.channel == Channel::kRange && s.covariate == covariate && s.score > best.score) best = s;
  }
  return best;
}

// 1.1 mm RMS in 8 mm of noise, in all scenes: less than the share that is always worth a mention.
TEST(NotableStructure, FaintStructureIsMentionedIfAllScenesShowIt) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.0016 * std::sin(40.0 * beam.azimuth_rad); };
  test::TableRecipe recipe;
  recipe.range_rows = 6000;
  recipe.scenes = 12;  // every azimuth in several of them
  const auto made = test::synthetic_table(recipe, wrong);
  const auto scores = scan_structure(made.table, made.truth, {}, {}).curves;
  const StructureScore ripple = best_of(scores, "azimuth");
  EXPECT_GT(ripple.score, 0.01);
  EXPECT_LT(ripple.score, 0.02);
  EXPECT_EQ(ripple.scene_gain.size(), 12U);
  EXPECT_TRUE(is_notable(ripple, scores.size(), {}))
      << ripple.score << ": " << ::testing::PrintToString(ripple.scene_gain);
}

TEST(NotableStructure, AFaintScoreThatFewScenesMakeIsChance) {
  StructureScore score;
  score.score = 0.015;
  score.scene_gain = {30.0, 25.0, 28.0, 31.0, 26.0, 29.0};
  EXPECT_TRUE(is_notable(score, 100, {}));
  score.scene_gain = {3.0, 2.5, 2.8, 3.1, 2.6, 2.9};
  EXPECT_TRUE(is_notable(score, 100, {}));
  EXPECT_FALSE(is_notable(score, 1000000000, {})) << "chance does as much among so many";
  score.scene_gain = {170.0, -2.0, -1.0, 2.0, -3.0, 3.0};
  EXPECT_FALSE(is_notable(score, 100, {})) << "one scene";
  score.scene_gain = {1.0, 1.0, 0.9, 1.2, 1.0, 1.1};
  EXPECT_FALSE(is_notable(score, 100, {})) << "too little";
  score.score = 0.005;
  score.scene_gain = {300.0, 250.0, 280.0, 310.0, 260.0, 290.0};
  EXPECT_FALSE(is_notable(score, 100, {})) << "sure, but too small to matter";
  score.score = 0.03;
  score.scene_gain = {170.0, -2.0, -1.0, 2.0, -3.0, 3.0};
  EXPECT_TRUE(is_notable(score, 100, {})) << "large";
}

TEST(StructurePlaces, ABumpOnTheBoardIsSeenOverBothAxesTogether) {
  test::Disturbance wrong;
  test::TableRecipe recipe;
  recipe.range_rows = 6000;
  const Eigen::Vector2d bump =
      test::synthetic_table({}).table.target.outline().center_m() + Eigen::Vector2d(0.1, -0.08);
  wrong.range_m = [bump](const BeamPoint& beam) {
    return -0.012 * std::exp(-0.5 * (beam.board_m - bump).squaredNorm() / (0.05 * 0.05));
  };
  const auto made = test::synthetic_table(recipe, wrong);
  const auto scan = scan_structure(made.table, made.truth, {}, {});
  const auto& places = scan.places;
  ASSERT_FALSE(places.empty());
  EXPECT_EQ(places.front().channel, Channel::kRange);
  EXPECT_THAT(places.front().covariates(), ElementsAre("board x", "board y"));
  DiscoveryOptions options;
  options.min_structure = 0.01;
  const auto notable = notable_of(scan, options);
  ASSERT_FALSE(notable.empty());
  EXPECT_THAT(notable.front().covariates(), ElementsAre("board x", "board y"));
}

// Edges that lie off everywhere do so over every covariate, and at no place more than elsewhere.
TEST(StructurePlaces, WhatIsEverywhereIsAtNoPlace) {
  test::Disturbance wrong;
  wrong.edge_m = [](const BoundaryRow&) { return 0.001; };
  wrong.range_m = [](const BeamPoint& beam) { return 0.008 * std::sin(20.0 * beam.board_m.y()); };
  test::TableRecipe recipe;
  recipe.edge_sigma_m = 0.0001;  // Levels take most of it.
  const auto made = test::synthetic_table(recipe, wrong);
  int seen = 0;
  for (const StructureScore& s : scan_structure(made.table, made.truth, {}, {}).curves) {
    if (s.covariate != "board y") continue;
    ++seen;
    ASSERT_TRUE(s.is_at_a_place());
    const StructureScore again = place_score(
        s, made.table, residuals_and_nuisance(made.table, made.truth, {}, s.channel, {}));
    EXPECT_DOUBLE_EQ(again.score, s.score);
    EXPECT_DOUBLE_EQ(again.everywhere, s.everywhere);
    if (s.channel == Channel::kBoundary) {
      EXPECT_GT(s.score, 0.3);
      EXPECT_LT(s.local_score(), 0.02);
    } else if (s.channel == Channel::kRange) {
      EXPECT_GT(s.local_score(), 0.2);
      EXPECT_LT(s.everywhere, 0.02);
    }
  }
  EXPECT_GE(seen, 2);
}

TEST(StructurePlaces, WhatComesNearOnOnePrintOnlyIsSeenOverPrintAndRange) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) {
    return beam.darkness < 0.5 && beam.range_m < 2.8 ? -0.01 * (2.8 - beam.range_m) : 0.0;
  };
  const auto made = test::synthetic_table({}, wrong);
  const auto found = notable_of(scan_structure(made.table, made.truth, {}, {}), {});
  EXPECT_TRUE(std::any_of(found.begin(), found.end(), [](const StructureScore& s) {
    return s.channel == Channel::kRange && s.covariate == "print" && s.second_covariate == "range";
  }));
}

TEST(StructurePlaces, ARippleOverOneCovariateIsNoSurface) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.008 * std::sin(40.0 * beam.azimuth_rad); };
  const auto made = test::synthetic_table({}, wrong);
  for (const StructureScore& s : scan_structure(made.table, made.truth, {}, {}).places)
    EXPECT_NE(s.covariate, "azimuth");
}

// A bump is a small share of the variance by nature: its height counts, if all scenes show it.
TEST(NotableStructure, SomethingLocalIsJudgedByItsHeight) {
  test::TableRecipe recipe;
  recipe.range_rows = 15000;
  const Eigen::Vector2d bump =
      test::synthetic_table({}).table.target.outline().center_m() + Eigen::Vector2d(0.1, -0.08);
  const auto share_and_notable = [&](double height_m) {
    test::Disturbance wrong;
    wrong.range_m = [=](const BeamPoint& beam) {
      return -height_m * std::exp(-0.5 * (beam.board_m - bump).squaredNorm() / (0.05 * 0.05));
    };
    const auto made = test::synthetic_table(recipe, wrong);
    std::vector<std::string> named;
    for (const StructureScore& s : notable_of(scan_structure(made.table, made.truth, {}, {}), {})) {
      EXPECT_LT(s.score, 0.01);
      named.push_back(joined(s.covariates(), " and "));
    }
    return named;
  };
  EXPECT_THAT(share_and_notable(0.004), ::testing::Contains("board x and board y"));
  EXPECT_THAT(share_and_notable(0.0), ::testing::IsEmpty());
}

}  // namespace
}  // namespace lvcalib
