// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/shape_slope.h"

#include <cmath>

#include <gtest/gtest.h>

#include "model/residuals.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

TEST(ShapeSlope, IsTheDerivativeByTheShapeNumber) {
  test::TableRecipe recipe;
  recipe.scenes = 2;
  recipe.range_rows = 100;
  const auto made = test::synthetic_table(recipe);
  // By hand: d/dU [a sin(2πr/U) + b cos(2πr/U)].
  const double period = 0.37;
  const EffectInUse use{find_effect("range_cyclic"), period, Eigen::Vector2d(0.003, -0.002)};
  const EffectInUse slope{make_shape_slope(use, made.table), 0.0, Eigen::VectorXd::Ones(1)};
  const auto without = residuals_of(made.table, made.truth, {}, Channel::kRange);
  const auto with = residuals_of(made.table, made.truth, {slope}, Channel::kRange);
  for (std::size_t k = 0; k < with.values.size(); ++k) {
    const double r = made.table.range[k].beam.range_m;
    const double phase = 2.0 * M_PI * r / period;
    const double expected = -phase / period * (0.003 * std::cos(phase) + 0.002 * std::sin(phase));
    EXPECT_NEAR(without.values[k] - with.values[k], expected, 2e-4);
  }
}

TEST(ShapeSlope, IsOneSidedWhereTheShapeEnds) {
  test::TableRecipe recipe;
  recipe.scenes = 1;
  recipe.range_rows = 50;
  auto made = test::synthetic_table(recipe);
  for (RangeRow& row : made.table.range) row.beam.darkness = 0.5;
  const EffectInUse use{find_effect("range_walk"), 0.0, Eigen::VectorXd::Constant(1, 0.01)};
  const EffectInUse slope{make_shape_slope(use, made.table), 0.0, Eigen::VectorXd::Ones(1)};
  const auto without = residuals_of(made.table, made.truth, {}, Channel::kRange);
  const auto with = residuals_of(made.table, made.truth, {slope}, Channel::kRange);
  // g(½) = (e^{c/2} − 1)/(e^c − 1) with c = exponent · ln 10: its slope at 0 is −ln 10/8.
  for (std::size_t k = 0; k < with.values.size(); ++k)
    EXPECT_NEAR(without.values[k] - with.values[k], -0.01 * std::log(10.0) / 8.0, 1e-5);
}

}  // namespace
}  // namespace lvcalib
