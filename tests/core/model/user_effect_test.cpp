// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/user_effect.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/residuals.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;

test::SyntheticTable small_table() {
  test::TableRecipe recipe;
  recipe.scenes = 3;
  recipe.range_rows = 200;
  return test::synthetic_table(recipe);
}

std::string usage_error(const std::string& text) {
  const auto spec = parse_user_effect(text);
  EXPECT_FALSE(spec.ok()) << text;
  if (spec.ok()) return {};
  EXPECT_EQ(spec.error().kind, ErrorKind::kUsage);
  return spec.error().text();
}

std::string data_error(const std::string& text) {
  const auto made = small_table();
  const auto effect = make_user_effect(text, made.table, {});
  EXPECT_FALSE(effect.ok()) << text;
  if (effect.ok()) return {};
  EXPECT_EQ(effect.error().kind, ErrorKind::kInput);
  return effect.error().text();
}

// Change of every residual of a channel when the effect is in use with the values.
std::vector<double> change(const test::SyntheticTable& made, Channel channel, EffectInUse use) {
  const auto before = residuals_of(made.table, made.truth, {}, channel);
  const auto after = residuals_of(made.table, made.truth, {std::move(use)}, channel);
  std::vector<double> out;
  for (std::size_t k = 0; k < before.values.size(); ++k)
    out.push_back(before.values[k] - after.values[k]);
  return out;
}

TEST(UserEffect, TellsItsTextsFromTheCatalogue) {
  EXPECT_TRUE(is_user_effect("formula:range:a"));
  EXPECT_TRUE(is_user_effect(" curve:range:azimuth"));
  EXPECT_FALSE(is_user_effect("range_walk"));
}

TEST(UserEffect, ErrorsInTheTextAreSaid) {
  EXPECT_THAT(usage_error("formula:range"), HasSubstr("expected 'formula:CHANNEL:EXPRESSION'"));
  EXPECT_THAT(usage_error("curve:range:"), HasSubstr("curve:range:azimuth"));
  EXPECT_THAT(usage_error("formula:rnge:a"), HasSubstr("did you mean 'range'?"));
  EXPECT_THAT(usage_error("curve:range:azimut"), HasSubstr("did you mean 'azimuth'?"));
  EXPECT_THAT(usage_error("curve:range:azimuth,range,elevation"), HasSubstr("3 covariates"));
  EXPECT_THAT(usage_error("curve:range:azimuth,azimuth"), HasSubstr("twice"));
  EXPECT_THAT(usage_error("curve:range:azimuth,line"), HasSubstr("two scales"));
  EXPECT_THAT(usage_error("curve:range:azimuth[3..1]"), HasSubstr("[low..high]"));
  EXPECT_THAT(usage_error("formula:range:a*sin(range"), HasSubstr("character"));
}

TEST(UserEffect, WhatTheDataCannotBearIsSaidWithTheReason) {
  EXPECT_THAT(data_error("formula:range:a/(board_x-board_x)"),
              HasSubstr("not a finite number on 600 of 600 rows"));
  EXPECT_THAT(data_error("formula:range:a*exp(b*range)"), HasSubstr("not linear"));
  EXPECT_THAT(data_error("formula:range:a*sin(b*range)"), HasSubstr("linear"));
  EXPECT_THAT(data_error("formula:range:a*a*range"), HasSubstr("not linear in the coefficient a"));
  EXPECT_THAT(data_error("formula:range:a*range+0.001"), HasSubstr("not zero when"));
  EXPECT_THAT(data_error("formula:range:a*range+b*range*2"), HasSubstr("a and b cannot be told"));
  EXPECT_THAT(data_error("formula:range:a*range+0*b"), HasSubstr("coefficient b changes nothing"));
  test::TableRecipe recipe;
  recipe.scenes = 2;
  recipe.range_rows = 20;
  recipe.time = false;
  const auto timeless = test::synthetic_table(recipe);
  EXPECT_THAT(make_user_effect("curve:range:time_in_scan", timeless.table, {}).error().text(),
              HasSubstr("no time in scan"));
}

TEST(UserEffect, FormulaOfTheRangeAddsItsValueToTheRangesOnly) {
  const auto made = small_table();
  const auto effect = make_user_effect("formula:range:a*sin(2*azimuth)", made.table, {});
  ASSERT_TRUE(effect.ok()) << effect.error().text();
  EXPECT_THAT((*effect)->info().formula, HasSubstr("azimuth [rad]"));
  const auto parameters = (*effect)->parameters(made.table);
  ASSERT_EQ(parameters.size(), 1U);
  EXPECT_EQ(parameters[0].unit, "mm");
  const EffectInUse use{*effect, 0.0, Eigen::VectorXd::Constant(1, 0.004)};
  const auto range = change(made, Channel::kRange, use);
  for (std::size_t k = 0; k < range.size(); ++k)
    EXPECT_NEAR(range[k], 0.004 * std::sin(2.0 * made.table.range[k].beam.azimuth_rad), 1e-12);
  // Along the beam: edges stay where they are.
  for (const double d : change(made, Channel::kBoundary, use)) EXPECT_NEAR(d, 0.0, 1e-12);
}

TEST(UserEffect, PriorsAreTheSameInEffectWhateverTheUnits) {
  const auto made = small_table();
  const UserEffectOptions options;
  for (const char* text : {"formula:range:a*range", "formula:range:a*1000*range"}) {
    const auto effect = make_user_effect(text, made.table, options);
    const auto p = (*effect)->parameters(made.table);
    const auto moved = change(made, Channel::kRange,
                              {*effect, 0.0, Eigen::VectorXd::Constant(1, p[0].prior_sigma)});
    double squares = 0.0;
    for (const double d : moved) squares += d * d / static_cast<double>(moved.size());
    EXPECT_NEAR(std::sqrt(squares), options.believable[1], 1e-9) << text;
    EXPECT_NEAR(p[0].size_of_interest / p[0].prior_sigma,
                options.size_of_interest[1] / options.believable[1], 1e-9);
  }
}

TEST(UserEffect, EveryChannelCanBeReached) {
  const auto made = small_table();
  const struct {
    const char* text;
    Channel channel;
  } cases[] = {{"formula:corner:(1-axis)*a*image_y", Channel::kCorner},
               {"formula:range:a*print", Channel::kRange},
               {"formula:boundary:a*cos(2*polar_angle)", Channel::kBoundary},
               {"formula:intensity:a*ln(range)", Channel::kIntensity},
               {"curve:corner:image_radius", Channel::kCorner},
               {"curve:boundary:polar_angle", Channel::kBoundary},
               {"curve:intensity:line", Channel::kIntensity}};
  for (const auto& c : cases) {
    const auto effect = make_user_effect(c.text, made.table, {});
    ASSERT_TRUE(effect.ok()) << effect.error().text();
    const auto n = static_cast<Eigen::Index>((*effect)->parameters(made.table).size());
    const EffectInUse use{*effect, (*effect)->shapes(made.table).front(),
                          Eigen::VectorXd::LinSpaced(n, 0.01, 0.02)};
    for (const Channel channel : kAllChannels) {
      double size = 0.0;
      for (const double d : change(made, channel, use)) size += std::abs(d);
      // An edge is seen in intensities: what changes these changes those in its blur.
      const bool reached = channel == c.channel ||
                           (c.channel == Channel::kIntensity && channel == Channel::kBoundary);
      EXPECT_EQ(size > 1e-9, reached) << c.text << " in " << name_of(channel);
    }
  }
  // The axis in a corner's formula: nothing moves along v.
  const auto effect = make_user_effect(cases[0].text, made.table, {});
  const auto moved =
      change(made, Channel::kCorner, {*effect, 0.0, Eigen::VectorXd::Constant(1, 0.001)});
  for (std::size_t k = 0; k + 1 < moved.size(); k += 2) {
    EXPECT_NEAR(moved[k], 0.001 * made.table.corner[k / 2].pixel.y(), 1e-9);
    EXPECT_EQ(moved[k + 1], 0.0);
  }
}

TEST(UserEffect, TheSpecMakesTheSameEffectWithoutTheData) {
  const auto made = small_table();
  for (const char* text : {"curve:range:azimuth", "curve:range:line", "curve:range:azimuth,range",
                           "formula:range:a*range+b*sqrt(range)"}) {
    const auto effect = make_user_effect(text, made.table, {});
    ASSERT_TRUE(effect.ok()) << effect.error().text();
    EXPECT_EQ((*effect)->info().id, text);
    const auto again = make_user_effect((*effect)->info().spec);
    ASSERT_TRUE(again.ok()) << again.error().text();
    const auto n = static_cast<Eigen::Index>((*effect)->parameters(made.table).size());
    const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(n, 0.001, 0.002);
    const double shape = (*effect)->shapes(made.table).back();
    EXPECT_EQ(change(made, Channel::kRange, {*effect, shape, values}),
              change(made, Channel::kRange, {*again, shape, values}))
        << text;
  }
  EXPECT_THAT(make_user_effect("curve:range:azimuth").error().text(), HasSubstr("interval"));
}

TEST(UserEffect, OptionsAreChecked) {
  UserEffectOptions options;
  EXPECT_TRUE(options.check().ok());
  options.size_of_interest[1] = 1.0;
  EXPECT_FALSE(options.check().ok());
  options = {};
  options.tensor_splines = 2;
  EXPECT_FALSE(options.check().ok());
}

}  // namespace
}  // namespace lvcalib
