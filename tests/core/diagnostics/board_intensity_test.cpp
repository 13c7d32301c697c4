// SPDX-License-Identifier: GPL-3.0-or-later
#include "diagnostics/board_intensity.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/statistics.h"
#include "selection/model_session.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

ModelStepPtr step_with(double falling) {
  test::TableRecipe recipe;
  recipe.edge_sigma_m = 1e-6;
  recipe.intensity_sigma = 1e-4;
  auto made = test::synthetic_table(recipe);
  for (RangeRow& row : made.table.range) {
    // What the print returns, and less of it from afar.
    row.intensity = made.table.level_of(row.print) * std::exp(falling * row.beam.range_m);
  }
  return *start_model(made.table, made.truth, {}, {});
}

TEST(BoardIntensityTest, APrintAsExpectedLeavesNoDifference) {
  const ModelStepPtr step = step_with(0.0);
  const BoardIntensity image = board_intensity(step->fitted(), -1);
  ASSERT_GT(image.columns, 10);
  ASSERT_EQ(image.measured.size(), static_cast<std::size_t>(image.columns * image.rows));
  std::vector<double> measured;
  int cells = 0;
  for (std::size_t k = 0; k < image.measured.size(); ++k) {
    if (std::isnan(image.measured[k])) continue;
    ++cells;
    measured.push_back(static_cast<double>(image.measured[k]));
    EXPECT_NEAR(static_cast<double>(image.difference[k]), 0.0, 0.1);
  }
  EXPECT_GT(cells, 100);
  EXPECT_NEAR(quantile(measured, 0.02), 10.0, 2.0) << "black";
  EXPECT_NEAR(quantile(measured, 0.98), 100.0, 2.0) << "white";
}

TEST(BoardIntensityTest, WhatThePrintDoesNotExplainIsLeft) {
  const ModelStepPtr step = step_with(-0.3);
  const BoardIntensity image = board_intensity(step->fitted(), 0, 0.05);
  double sum = 0.0;
  for (const float d : image.difference) {
    if (!std::isnan(d)) sum += static_cast<double>(d);
  }
  EXPECT_LT(sum, 0.0) << "darker than predicted";
}

TEST(BoardIntensityTest, WithoutIntensityThereIsNone) {
  auto made = test::synthetic_table({});
  made.table.has_intensity = false;
  const auto step = start_model(made.table, made.truth, {}, {});
  ASSERT_TRUE(step);
  EXPECT_TRUE(board_intensity((*step)->fitted(), -1).measured.empty());
}

}  // namespace
}  // namespace lvcalib
