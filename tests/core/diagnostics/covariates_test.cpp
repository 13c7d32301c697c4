// SPDX-License-Identifier: GPL-3.0-or-later
#include "diagnostics/covariates.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

const Covariate* find(const std::vector<Covariate>& list, const std::string& name) {
  const auto at =
      std::find_if(list.begin(), list.end(), [&](const Covariate& c) { return c.name == name; });
  return at == list.end() ? nullptr : &*at;
}

TEST(Covariates, EveryChannelHasOneValuePerResidual) {
  test::TableRecipe recipe;
  recipe.scenes = 3;
  recipe.range_rows = 50;
  const auto made = test::synthetic_table(recipe);
  for (const Channel channel : kAllChannels) {
    const auto residuals = residuals_of(made.table, made.truth, {}, channel);
    const auto covariates = covariates_of(made.table, channel, residuals);
    EXPECT_GE(covariates.size(), 9U) << name_of(channel);
    for (const Covariate& c : covariates) {
      EXPECT_EQ(c.values.size(), residuals.values.size()) << c.name;
      EXPECT_GT(*std::max_element(c.values.begin(), c.values.end()),
                *std::min_element(c.values.begin(), c.values.end()))
          << c.name << " does not vary";
    }
  }
}

TEST(Covariates, ValuesAreThoseOfTheRows) {
  test::TableRecipe recipe;
  recipe.scenes = 2;
  recipe.range_rows = 30;
  const auto made = test::synthetic_table(recipe);
  const auto residuals = residuals_of(made.table, made.truth, {}, Channel::kRange);
  const auto covariates = covariates_of(made.table, Channel::kRange, residuals);
  const Covariate* azimuth = find(covariates, "azimuth");
  ASSERT_NE(azimuth, nullptr);
  for (std::size_t k = 0; k < residuals.row.size(); ++k) {
    EXPECT_FLOAT_EQ(azimuth->values[k],
                    static_cast<float>(made.table.range[residuals.row[k]].beam.azimuth_rad));
  }
}

TEST(Covariates, WhatTheCloudsLackIsNotListed) {
  test::TableRecipe recipe;
  recipe.scenes = 2;
  recipe.range_rows = 30;
  recipe.time = recipe.lines = false;
  const auto made = test::synthetic_table(recipe);
  const auto residuals = residuals_of(made.table, made.truth, {}, Channel::kRange);
  const auto covariates = covariates_of(made.table, Channel::kRange, residuals);
  EXPECT_EQ(find(covariates, "time in scan"), nullptr);
  EXPECT_EQ(find(covariates, "line"), nullptr);
  EXPECT_NE(find(covariates, "range"), nullptr);
}

}  // namespace
}  // namespace lvcalib
