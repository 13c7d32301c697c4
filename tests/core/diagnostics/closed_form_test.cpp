// SPDX-License-Identifier: GPL-3.0-or-later
#include "diagnostics/closed_form.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/user_effect.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

ClosedForm form_of(const std::function<double(const BeamPoint&)>& planted, const char* covariate) {
  test::Disturbance wrong;
  wrong.range_m = planted;
  const auto made = test::synthetic_table({}, wrong);
  const auto residuals = residuals_and_nuisance(made.table, made.truth, {}, Channel::kRange);
  for (const Covariate& c : covariates_of(made.table, Channel::kRange, residuals)) {
    if (c.name == covariate) return closed_form_of(c, Channel::kRange, residuals, 6);
  }
  return {};
}

TEST(ClosedForm, FindsAWaveAndGivesItAsAFormula) {
  const auto form = form_of(
      [](const BeamPoint& beam) { return 0.006 * std::sin(20.0 * beam.azimuth_rad); }, "azimuth");
  EXPECT_THAT(form.formula, HasSubstr("formula:range:"));
  EXPECT_THAT(form.formula, HasSubstr("sin("));
  EXPECT_TRUE(parse_user_effect(form.formula).ok()) << form.formula;
  // The planted wave has about 18 mm² of variance, the noise 64 mm².
  EXPECT_GT(form.score, 0.12);
}

TEST(ClosedForm, FindsAStep) {
  const auto form = form_of([](const BeamPoint& beam) { return beam.time_s > 0.05 ? 0.008 : 0.0; },
                            "time in scan");
  EXPECT_THAT(form.formula, HasSubstr("time_in_scan > "));
  EXPECT_TRUE(parse_user_effect(form.formula).ok()) << form.formula;
}

TEST(ClosedForm, TakesOneTermWhereOneIsEnough) {
  const auto form =
      form_of([](const BeamPoint& beam) { return 0.3 * beam.time_s; }, "time in scan");
  EXPECT_EQ(form.formula, "formula:range:a*time_in_scan");
}

TEST(ClosedForm, NothingIsFoundInNoiseAndLabels) {
  EXPECT_THAT(form_of(nullptr, "azimuth").formula, IsEmpty());
  EXPECT_THAT(form_of(nullptr, "line").formula, IsEmpty());
}

}  // namespace
}  // namespace lvcalib
