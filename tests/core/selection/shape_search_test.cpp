// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "selection/effect_search.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

test::SyntheticTable wave(double period_m, std::uint64_t seed, double amplitude_m = 0.004) {
  test::Disturbance wrong;
  wrong.range_m = [=](const BeamPoint& beam) {
    return amplitude_m * std::sin(2.0 * M_PI * beam.range_m / period_m + 0.4);
  };
  test::TableRecipe recipe;
  recipe.seed = seed;
  return test::synthetic_table(recipe, wrong);
}

TEST(ShapeSearch, PeriodMovesOffTheGridToTheTruthWithinItsDeviation) {
  constexpr double kPeriod = 0.3137;  // not on the grid
  const EffectPtr cyclic = find_effect("range_cyclic");
  double squares = 0.0;
  constexpr int kSeeds = 8;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto made = wave(kPeriod, seed);
    const DiscoveryOptions options;
    const RunContext context;
    EffectSearch search(made.table, made.truth, options, context);
    search.add(cyclic, search.preferred_shape(cyclic));
    const double on_grid = std::abs(search.in_use()[0].shape - kPeriod);
    search.refine_shapes();
    const double error = search.in_use()[0].shape - kPeriod;
    EXPECT_GT(search.shape_sigma(0), 0.0);
    EXPECT_LT(search.shape_sigma(0), 0.002);
    EXPECT_LE(std::abs(error), on_grid + 2.0 * search.shape_sigma(0));
    squares += error * error / (search.shape_sigma(0) * search.shape_sigma(0));
    // The amplitude's deviation grows by what the period leaves open.
    EXPECT_GE(search.joint_covariance()(6, 6),
              search.reference().fit.covariance(6, 6) * (1.0 - 1e-9));
  }
  // χ² with 8 degrees of freedom: 2.2 to 17.5 hold 95 %.
  EXPECT_GT(squares, 1.6);
  EXPECT_LT(squares, 20.1);
}

// Nearer to the truth than either of its neighbours among the places that are tried first, and yet
// many deviations from it.
TEST(ShapeSearch, AShapeBetweenThePlacesTriedIsNotLeftThere) {
  const EffectPtr cyclic = find_effect("range_cyclic");
  std::vector<double> grid = cyclic->shapes(test::synthetic_table({}).table);
  std::sort(grid.begin(), grid.end());
  ASSERT_GE(grid.size(), 5U);
  const std::size_t middle = grid.size() / 2;
  const double step = (grid[middle + 1] - grid[middle - 1]) / 8.0;
  const double truth = grid[middle - 1] + 4.5 * step;
  const auto made = wave(truth, 1, 0.1);
  const DiscoveryOptions options;
  const RunContext context;
  for (const double away : {-0.3, 0.3}) {
    EffectSearch search(made.table, made.truth, options, context);
    search.add(cyclic, truth + away * step);
    search.refine_shapes();
    EXPECT_LT(8.0 * search.shape_sigma(0), std::abs(away) * step);
    EXPECT_NEAR(search.in_use()[0].shape, truth, 4.0 * search.shape_sigma(0));
  }
}

TEST(ShapeSearch, EffectsWithoutShapeAreLeftAlone) {
  const auto made = test::synthetic_table({});
  const DiscoveryOptions options;
  const RunContext context;
  EffectSearch search(made.table, made.truth, options, context);
  search.add(find_effect("range_scale"), 0.0);
  const Rigid3 before = search.state().camera_from_lidar;
  search.refine_shapes();
  EXPECT_EQ(search.shape_sigma(0), 0.0);
  EXPECT_EQ(search.state().camera_from_lidar.matrix(), before.matrix());
  EXPECT_EQ(search.joint_covariance(), search.reference().fit.covariance);
}

}  // namespace
}  // namespace lvcalib
