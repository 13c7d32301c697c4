// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/linear_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "model/mixed_model.h"
#include "model/residuals.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

// Also on its edges, and of what lies a little beyond them.
TEST(BoardPatches, HoldEveryPlaceOnTheBoard) {
  BoardOutline outline;
  outline.lower_left_m = {-0.1, 0.2};
  outline.upper_right_m = {0.6, 0.69};
  const BoardPatches patches(outline, 0.2);
  EXPECT_EQ(patches.columns, 4);
  EXPECT_EQ(patches.rows, 3);
  EXPECT_EQ(patches.of(outline, {-0.1, 0.2}), 0);
  EXPECT_EQ(patches.of(outline, {0.6, 0.2}), 3);
  EXPECT_EQ(patches.of(outline, {-0.1, 0.69}), 8);
  EXPECT_EQ(patches.of(outline, {0.6, 0.69}), 11);
  EXPECT_EQ(patches.of(outline, {0.7, 0.8}), 11);
  EXPECT_EQ(patches.of(outline, {-0.2, 0.1}), 0);
  EXPECT_EQ(patches.of(outline, outline.lower_left_m + Eigen::Vector2d(0.36, 0.17)), 6);
}

// Every effect of the catalogue, in every channel: the column is the change of the prediction per
// unit of the parameter.
class EffectDerivative : public ::testing::TestWithParam<std::string> {};

TEST_P(EffectDerivative, ResidualsFallByTheColumnTimesTheValue) {
  test::TableRecipe recipe;
  recipe.scenes = 2;
  recipe.range_rows = 40;
  const auto made = test::synthetic_table(recipe);
  const EffectPtr effect = find_effect(GetParam());
  ASSERT_NE(effect, nullptr);
  const double shape = effect->shapes(made.table).back();
  const auto parameters = effect->parameters(made.table);
  EffectColumnsList columns;
  columns.add(effect, shape, made.table);
  const Linearization linear = linearize(made.table, made.truth, {}, columns, {});
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    EffectInUse use{effect, shape,
                    Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters.size()))};
    // Edges are curved: their prediction is linear in small displacements only.
    const double step = 0.01 * parameters[p].size_of_interest;
    use.values(static_cast<Eigen::Index>(p)) = step;
    std::array<double, kChannels> expected{};
    for (const SceneProducts& scene : linear.scenes) {
      const auto at = scene.layout.size() + 6 + static_cast<int>(p);
      for (std::size_t c = 0; c < kChannels; ++c)
        expected[c] += step * step * scene.products[c](at, at);
    }
    // Plain print has the far tails of edges, which are not linear; they do not count.
    const double most = *std::max_element(expected.begin(), expected.end());
    for (const Channel channel : kAllChannels) {
      const auto before = residuals_of(made.table, made.truth, {}, channel);
      const auto after = residuals_of(made.table, made.truth, {use}, channel);
      // Σ (change/σ)² must be step² times the column's entry in the cross products.
      double squares = 0.0;
      for (std::size_t k = 0; k < before.values.size(); ++k)
        squares += std::pow((before.values[k] - after.values[k]) / before.sigma[k], 2);
      const double wanted = expected[static_cast<std::size_t>(channel)];
      EXPECT_NEAR(squares, wanted, 5e-3 * wanted + 1e-4 * most + 1e-12) << name_of(channel);
    }
  }
}

TEST_P(EffectDerivative, ActsOnSomething) {
  test::TableRecipe recipe;
  recipe.scenes = 3;
  recipe.range_rows = 200;
  auto made = test::synthetic_table(recipe);
  for (RangeRow& row : made.table.range) row.beam.edge = NearEdge{0.002, 0.4, 0.01};
  const EffectPtr effect = find_effect(GetParam());
  EffectColumnsList columns;
  columns.add(effect, effect->shapes(made.table).front(), made.table);
  const Linearization linear = linearize(made.table, made.truth, {}, columns, {});
  for (int p = 0; p < columns.columns(); ++p) {
    double information = 0.0;
    for (const SceneProducts& scene : linear.scenes) {
      for (const auto& m : scene.products) {
        information += m(scene.layout.size() + 6 + p, scene.layout.size() + 6 + p);
      }
    }
    EXPECT_GT(information, 0.0) << "parameter " << p;
  }
}

std::vector<std::string> all_effect_ids() {
  std::vector<std::string> ids;
  for (const EffectPtr& effect : effect_catalogue()) ids.push_back(effect->info().id);
  return ids;
}
INSTANTIATE_TEST_SUITE_P(Catalogue, EffectDerivative, ::testing::ValuesIn(all_effect_ids()),
                         [](const auto& info) { return info.param; });

TEST(Linearize, PoseColumnsAreTheDerivativesOfTheResiduals) {
  test::TableRecipe recipe;
  recipe.scenes = 1;
  recipe.range_rows = 60;
  const auto made = test::synthetic_table(recipe);
  for (const Channel channel : {Channel::kCorner, Channel::kRange, Channel::kBoundary}) {
    const auto base = residuals_and_nuisance(made.table, made.truth, {}, channel);
    for (int k = 0; k < 6; ++k) {
      Vector6d xi = Vector6d::Zero();
      xi(k) = 1e-6;
      const auto step =
          residuals_of(made.table, moved(made.truth, Vector6d::Zero(), {xi}), {}, channel);
      for (std::size_t r = 0; r < base.values.size(); ++r) {
        const double numeric = (base.values[r] - step.values[r]) / 1e-6;
        EXPECT_NEAR(base.nuisance[r](k), numeric, 2e-3 * (1.0 + std::abs(numeric)))
            << name_of(channel) << " row " << r << " direction " << k;
      }
    }
  }
}

// On white print the contrast does what the effect does, elsewhere the opposite, and only to
// ranges: both columns together are twice the effect on white and nothing on black.
TEST(Linearize, PrintContrastTurnsItsSignBetweenPrints) {
  auto made = test::synthetic_table({});
  const EffectPtr effect = find_effect("range_scale");
  for (const Print kept : {Print::kWhite, Print::kBlack}) {
    MeasurementTable table = made.table;
    std::erase_if(table.range, [&](const RangeRow& row) {
      return (row.print == Print::kWhite) != (kept == Print::kWhite);
    });
    ASSERT_FALSE(table.range.empty());
    EffectColumnsList columns;
    columns.add(effect, 0.0, table);
    columns.add_print_contrast(effect, 0.0, table);
    const Linearization linear = linearize(table, made.truth, {}, columns, {});
    for (const SceneProducts& s : linear.scenes) {
      const int at = s.layout.size() + 6;
      const Eigen::MatrixXd& range = s.products[static_cast<std::size_t>(Channel::kRange)];
      EXPECT_GT(range(at, at), 0.0);
      EXPECT_DOUBLE_EQ(range(at + 1, at + 1), range(at, at));
      EXPECT_DOUBLE_EQ(range(at, at + 1), kept == Print::kWhite ? range(at, at) : -range(at, at));
      EXPECT_EQ(s.products[static_cast<std::size_t>(Channel::kBoundary)](at + 1, at + 1), 0.0);
    }
  }
}

TEST(Linearize, CountsRowsAndDoesNotDependOnThreads) {
  test::TableRecipe recipe;
  recipe.scenes = 3;
  recipe.range_rows = 100;
  const auto made = test::synthetic_table(recipe);
  EffectColumnsList columns;
  columns.add(find_effect("range_offset"), 0.0, made.table);
  RunContext one;
  one.threads = 1;
  RunContext two;
  two.threads = 2;
  const Linearization a = linearize(made.table, made.truth, {}, columns, one);
  const Linearization b = linearize(made.table, made.truth, {}, columns, two);
  ASSERT_EQ(a.scenes.size(), 3U);
  for (std::size_t s = 0; s < 3; ++s) {
    EXPECT_EQ(a.scenes[s].rows[static_cast<std::size_t>(Channel::kRange)], 100);
    EXPECT_EQ(a.scenes[s].rows[static_cast<std::size_t>(Channel::kBoundary)], 9 * 24);
    EXPECT_EQ(a.scenes[s].rows[static_cast<std::size_t>(Channel::kCorner)], 2 * 64);
    for (std::size_t c = 0; c < kChannels; ++c)
      EXPECT_EQ(a.scenes[s].products[c], b.scenes[s].products[c]);
  }
}

// What a return's range and its intensity share is asked once where both are summed.
TEST(Linearize, RowsOfOneReturnSayWhatTheySayAlone) {
  test::TableRecipe recipe;
  recipe.scenes = 2;
  recipe.range_rows = 9000;
  const auto made = test::synthetic_table(recipe);
  std::vector<EffectInUse> in_use;
  EffectColumnsList columns;
  // The second moves the light beside the return, the third lets black grow.
  for (const char* id : {"range_scale", "detector_lag", "boundary_bias"}) {
    const EffectPtr effect = find_effect(id);
    in_use.push_back({effect, 0.0, Eigen::VectorXd::Zero(1)});
    in_use.back().values(0) = 0.1 * effect->parameters(made.table).front().size_of_interest;
  }
  for (const EffectInUse& use : in_use) columns.add(use.effect, use.shape, made.table);
  for (const EffectPtr& effect : effect_catalogue())
    columns.add(effect, effect->shapes(made.table).front(), made.table);
  const Linearization together = linearize(made.table, made.truth, in_use, columns, {});
  for (std::size_t c = 0; c < kChannels; ++c) {
    ChannelMask one{};
    one[c] = true;
    const Linearization alone = linearize(made.table, made.truth, in_use, columns, {}, {one});
    for (std::size_t s = 0; s < 2; ++s) {
      EXPECT_GT(alone.scenes[s].rows[c], 0);
      EXPECT_EQ(together.scenes[s].rows[c], alone.scenes[s].rows[c]);
      const Eigen::MatrixXd& wanted = alone.scenes[s].products[c];
      const Eigen::VectorXd size = wanted.diagonal().cwiseSqrt().cwiseMax(1e-12);
      const Eigen::MatrixXd off = (together.scenes[s].products[c] - wanted).cwiseAbs();
      // Rounding: in what follows from the pose most of it cancels.
      EXPECT_LT(off.cwiseQuotient(size * size.transpose()).maxCoeff(), 1e-6) << c;
    }
  }
}

TEST(Linearize, TellsOnHowManyRowsAnEffectActs) {
  test::TableRecipe recipe;
  recipe.scenes = 2;
  recipe.range_rows = 4000;
  auto made = test::synthetic_table(recipe);
  // One range row in twenty lies at an edge.
  for (std::size_t k = 0; k < made.table.range.size(); k += 20)
    made.table.range[k].beam.edge = NearEdge{0.001, 0.3, 0.01};
  EffectColumnsList columns;
  columns.add(find_effect("range_offset"), 0.0, made.table);
  columns.add(find_effect("boundary_range_pull"), 0.0, made.table);
  const Linearization linear = linearize(made.table, made.truth, {}, columns, {});
  EXPECT_DOUBLE_EQ(linear.acting_share(Channel::kRange, 0), 1.0);
  const double pull = linear.acting_share(Channel::kRange, 1);
  EXPECT_GT(pull, 0.02);
  EXPECT_LT(pull, 0.15);  // three times 1/20 for equal values
  EXPECT_EQ(linear.acting_share(Channel::kCorner, 0), 0.0);
}

}  // namespace
}  // namespace lvcalib
