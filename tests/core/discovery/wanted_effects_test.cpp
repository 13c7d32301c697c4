// SPDX-License-Identifier: GPL-3.0-or-later
#include "discovery/wanted_effects.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class Wanted : public ::testing::Test {
 protected:
  WantedEffects add(const std::vector<std::string>& with) {
    options_.with = with;
    const auto out = add_wanted_effects(search_, options_);
    EXPECT_TRUE(out.ok()) << out.error().text();
    return *out;
  }
  DiscoveryOptions options_;
  RunContext context_;
  test::SyntheticTable made_ = test::synthetic_table({});
  EffectSearch search_{made_.table, made_.truth, options_, context_};
};

TEST(CheckWanted, NamesTheNearest) {
  EXPECT_TRUE(check_wanted({"range_walk", "formula:range:a*range", "curve:range:line"}).ok());
  EXPECT_THAT(check_wanted({"range_wak"}).error().text(), HasSubstr("did you mean 'range_walk'?"));
  EXPECT_THAT(check_wanted({"formula:range:a*azimut"}).error().text(), HasSubstr("azimuth"));
  EXPECT_EQ(check_wanted({"formula:range:a*("}).error().kind, ErrorKind::kUsage);
}

TEST_F(Wanted, GoOnWithTheRest) {
  const auto out = add({"formula:range:a/(board_x-board_x)", "range_walk", "range_walk",
                        "formula:range:a*range*range"});
  EXPECT_THAT(out.added, ElementsAre("range_walk", "formula:range:a*range*range"));
  EXPECT_THAT(out.warnings, SizeIs(2));
  EXPECT_THAT(out.warnings[0], HasSubstr("not a finite number on 9000 of 9000 rows"));
  EXPECT_THAT(out.warnings[1], HasSubstr("twice"));
  ASSERT_THAT(out.refused, SizeIs(1));
  EXPECT_EQ(out.refused[0].verdict, EffectVerdict::kNotTestable);
  EXPECT_EQ(search_.in_use().size(), 2U);
}

TEST_F(Wanted, WhatMakesTheSolveSingularIsLeftOut) {
  const auto out = add({"range_scale", "formula:range:a*range"});
  EXPECT_THAT(out.added, ElementsAre("range_scale"));
  ASSERT_THAT(out.warnings, SizeIs(1));
  EXPECT_THAT(out.warnings[0], HasSubstr("range_scale do, which makes the solve singular"));
  EXPECT_EQ(search_.in_use().size(), 1U);
  EXPECT_TRUE(search_.state().camera_from_lidar.translation.allFinite());
}

TEST_F(Wanted, FieldsThatAreMissingAreSaid) {
  test::TableRecipe recipe;
  recipe.time = false;
  const auto made = test::synthetic_table(recipe);
  EffectSearch search(made.table, made.truth, options_, context_);
  options_.with = {"scan_motion", "curve:range:time_in_scan"};
  const auto out = add_wanted_effects(search, options_);
  ASSERT_TRUE(out.ok());
  EXPECT_THAT(out->added, IsEmpty());
  EXPECT_THAT(out->warnings, SizeIs(2));
  for (const std::string& w : out->warnings) EXPECT_THAT(w, HasSubstr("no time"));
}

TEST(WantedFormula, RecoversTheCoefficientWithinItsDeviation) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.006 * std::sin(12.0 * beam.azimuth_rad); };
  const auto made = test::synthetic_table({}, wrong);
  DiscoveryOptions options;
  options.with = {"formula:range:a*sin(12*azimuth)+b*cos(12*azimuth)"};
  EffectSearch search(made.table, made.truth, options, {});
  ASSERT_TRUE(add_wanted_effects(search, options).ok());
  ASSERT_EQ(search.in_use().size(), 1U);
  const Eigen::VectorXd values = search.in_use()[0].values;
  const Eigen::MatrixXd covariance = search.joint_covariance().block<2, 2>(6, 6);
  EXPECT_NEAR(values(0), 0.006, 3.0 * std::sqrt(covariance(0, 0)));
  EXPECT_NEAR(values(1), 0.0, 3.0 * std::sqrt(covariance(1, 1)));
  EXPECT_LT(std::sqrt(covariance(0, 0)), 0.001);
}

TEST(WantedCurve, FollowsWhatIsThereAndStaysFlatWhereNothingIs) {
  for (const double size : {0.0, 0.006}) {
    test::Disturbance wrong;
    wrong.range_m = [size](const BeamPoint& beam) {
      return size * std::sin(12.0 * beam.azimuth_rad);
    };
    const auto made = test::synthetic_table({}, wrong);
    DiscoveryOptions options;
    options.with = {"curve:range:azimuth"};
    EffectSearch search(made.table, made.truth, options, {});
    ASSERT_TRUE(add_wanted_effects(search, options).ok());
    ASSERT_EQ(search.in_use().size(), 1U);
    const EffectInUse& use = search.in_use()[0];
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
