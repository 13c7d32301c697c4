// SPDX-License-Identifier: GPL-3.0-or-later
// Effects that the user asks for before anything is searched.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "selection/discovery.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// The model with what was asked for and nothing else.
Discovery with(const std::vector<std::string>& wanted, const test::SyntheticTable& made) {
  DiscoveryOptions options;
  options.with = wanted;
  options.max_effects = 0;
  options.advise_scenes = false;
  const auto out = discover_effects(made.table, made.truth, options, {});
  EXPECT_TRUE(out.ok()) << out.error().text();
  return *out;
}

TEST(CheckWanted, NamesTheNearest) {
  EXPECT_TRUE(check_wanted({"range_walk", "formula:range:a*range", "curve:range:line"}).ok());
  EXPECT_THAT(check_wanted({"range_wak"}).error().text(), HasSubstr("did you mean 'range_walk'?"));
  EXPECT_THAT(check_wanted({"formula:range:a*azimut"}).error().text(), HasSubstr("azimuth"));
  EXPECT_EQ(check_wanted({"formula:range:a*("}).error().kind, ErrorKind::kUsage);
  // Before any data: no data would mend it, and none are asked for what they alone can tell.
  EXPECT_THAT(check_wanted({"formula:range:a*a*range"}).error().text(),
              HasSubstr("not linear in the coefficient a"));
  EXPECT_THAT(check_wanted({"formula:range:a*range+0.001"}).error().text(),
              HasSubstr("not zero when"));
  EXPECT_TRUE(check_wanted({"formula:intensity:a*ln(range)+b*sqrt(range-2)"}).ok());
  EXPECT_TRUE(check_wanted({"formula:range:a*ln(-1-azimuth*azimuth)"}).ok());
}

TEST(Wanted, GoOnWithTheRest) {
  const auto out = with({"formula:range:a/(board_x-board_x)", "range_walk", "range_walk",
                         "formula:range:a*range*range"},
                        test::synthetic_table({}));
  EXPECT_TRUE(out.holds("range_walk") && out.holds("formula:range:a*range*range"));
  EXPECT_THAT(out.warnings, SizeIs(2));
  EXPECT_THAT(out.warnings[0], HasSubstr("not a finite number on 9000 of 9000 rows"));
  EXPECT_THAT(out.warnings[1], HasSubstr("twice"));
  EXPECT_EQ(out.effects.back().id, "formula:range:a/(board_x-board_x)");
  EXPECT_EQ(out.effects.back().verdict, EffectVerdict::kNotTestable);
  EXPECT_EQ(out.model.size(), 2U);
  EXPECT_THAT(out.history, SizeIs(3)) << "the base model first";
}

TEST(Wanted, WhatMakesTheSolveSingularIsLeftOut) {
  const auto out = with({"range_scale", "formula:range:a*range"}, test::synthetic_table({}));
  EXPECT_TRUE(out.holds("range_scale"));
  EXPECT_THAT(out.selected, IsEmpty()) << "the user asked for it";
  ASSERT_THAT(out.warnings, SizeIs(1));
  EXPECT_THAT(out.warnings[0], HasSubstr("range_scale do, which makes the solve singular"));
  EXPECT_EQ(out.model.size(), 1U);
  EXPECT_TRUE(out.state.camera_from_lidar.translation.allFinite());
}

TEST(Wanted, FieldsThatAreMissingAreSaid) {
  test::TableRecipe recipe;
  recipe.time = false;
  const auto out = with({"scan_motion", "curve:range:time_in_scan"}, test::synthetic_table(recipe));
  EXPECT_THAT(out.selected, IsEmpty());
  EXPECT_THAT(out.warnings, SizeIs(2));
  for (const Message& w : out.warnings)
    EXPECT_THAT(
        w, ::testing::AnyOf(HasSubstr("the time is not in every cloud"), HasSubstr("no time")));
}

TEST(WantedFormula, RecoversTheCoefficientWithinItsDeviation) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.006 * std::sin(12.0 * beam.azimuth_rad); };
  const auto made = test::synthetic_table({}, wrong);
  const auto out = with({"formula:range:a*sin(12*azimuth)+b*cos(12*azimuth)"}, made);
  ASSERT_EQ(out.model.size(), 1U);
  const std::vector<ParameterEstimate>& found = out.effects.front().parameters;
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].value, 0.006, 3.0 * found[0].sigma);
  EXPECT_NEAR(found[1].value, 0.0, 3.0 * found[1].sigma);
  EXPECT_LT(found[0].sigma, 0.001);
}

TEST(WantedCurve, FollowsWhatIsThereAndStaysFlatWhereNothingIs) {
  for (const double size : {0.0, 0.006}) {
    test::Disturbance wrong;
    wrong.range_m = [size](const BeamPoint& beam) {
      return size * std::sin(12.0 * beam.azimuth_rad);
    };
    const auto made = test::synthetic_table({}, wrong);
    const auto out = with({"curve:range:azimuth"}, made);
    ASSERT_EQ(out.model.size(), 1U);
    const EffectInUse& use = out.model[0];
    const CurveView* curve = as_curve(*use.effect);
    ASSERT_NE(curve, nullptr);
    // Where most beams are. A line over azimuth is all but a turn of the LiDAR: it may be anything.
    std::vector<double> x, y, truth;
    Eigen::VectorXd by(use.values.size());
    for (double a = -0.15; a < 0.151; a += 0.01) {
      curve->columns_at(std::array{a}, use.shape, {by.data(), static_cast<std::size_t>(by.size())});
      x.push_back(a);
      y.push_back(by.dot(use.values) - size * std::sin(12.0 * a));
    }
    Eigen::MatrixXd line(static_cast<Eigen::Index>(x.size()), 2);
    line.col(0).setOnes();
    line.col(1) = Eigen::Map<Eigen::VectorXd>(x.data(), line.rows());
    const Eigen::Map<Eigen::VectorXd> wrongness(y.data(), line.rows());
    const Eigen::VectorXd rest =
        wrongness - line * line.colPivHouseholderQr().solve(wrongness).eval();
    EXPECT_LT(std::sqrt(rest.squaredNorm() / static_cast<double>(rest.size())), 0.001)
        << "planted " << size;
  }
}

}  // namespace
}  // namespace lvcalib
