// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/row_covariates.h"

#include <set>

#include <gtest/gtest.h>

#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

TEST(RowCovariates, IdentifiersAreUniqueAndFindTheirCovariate) {
  for (const Channel channel : kAllChannels) {
    std::set<std::string> seen;
    for (const RowCovariate& c : row_covariates(channel)) {
      EXPECT_TRUE(seen.insert(c.identifier()).second) << c.name;
      EXPECT_EQ(find_covariate(channel, c.identifier()), &c);
      EXPECT_EQ(find_covariate(channel, c.name), &c);
    }
  }
  EXPECT_EQ(find_covariate(Channel::kRange, "Tilt Direction")->identifier(), "tilt_direction");
  EXPECT_EQ(find_covariate(Channel::kCorner, "azimuth"), nullptr);
}

TEST(RowCovariates, AreNamedInTheReadersWords) {
  EXPECT_EQ(covariates_named({"board x"}), Message::listed("board x"));
  EXPECT_EQ(covariates_named({"line"}), Message::listed("laser line"));
  EXPECT_EQ(covariates_named({"azimuth", "elevation"}).text(), "azimuth and elevation");
  EXPECT_TRUE(covariates_named({}).empty());
}

TEST(RowCovariates, AreFiniteOnEveryRowAndCornersComeTwice) {
  test::TableRecipe recipe;
  recipe.scenes = 2;
  recipe.range_rows = 40;
  const auto made = test::synthetic_table(recipe);
  for (const Channel channel : kAllChannels) {
    const auto sources = covariate_sources(made.table, channel);
    const std::size_t per_row = channel == Channel::kCorner ? 2 : 1;
    EXPECT_EQ(sources.size(), per_row * made.table.size(channel));
    for (const RowCovariate& c : row_covariates(channel)) {
      for (const CovariateSource& source : sources)
        ASSERT_TRUE(std::isfinite(c.value(made.table, source))) << c.name;
    }
  }
}

TEST(RowCovariates, BeamOnlyCovariatesNeedNothingElse) {
  test::TableRecipe recipe;
  recipe.scenes = 1;
  recipe.range_rows = 5;
  const auto made = test::synthetic_table(recipe);
  const RangeRow& row = made.table.range[3];
  for (const RowCovariate& c : row_covariates(Channel::kRange)) {
    if (!c.of_beam) continue;
    EXPECT_EQ(c.value(made.table, CovariateSource::of(row.beam)),
              c.value(made.table, CovariateSource::of(row)))
        << c.name;
  }
}

TEST(RowCovariates, ClaimsOnlyWhatTheCloudsHave) {
  test::TableRecipe recipe;
  recipe.scenes = 1;
  recipe.range_rows = 5;
  recipe.time = recipe.lines = false;
  const auto made = test::synthetic_table(recipe);
  EXPECT_FALSE(has_covariate(made.table, *find_covariate(Channel::kRange, "time in scan")));
  EXPECT_FALSE(has_covariate(made.table, *find_covariate(Channel::kRange, "line")));
  EXPECT_TRUE(has_covariate(made.table, *find_covariate(Channel::kRange, "range")));
}

}  // namespace
}  // namespace lvcalib
