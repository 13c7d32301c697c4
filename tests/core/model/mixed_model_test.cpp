// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/mixed_model.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "base/statistics.h"
#include "support/pose_matchers.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

ModelFit fit(const test::SyntheticTable& made, const std::vector<std::string>& ids,
             const MixedModelOptions& options = {}) {
  EffectColumnsList columns;
  ColumnSubset subset;
  for (const std::string& id : ids) {
    columns.add(find_effect(id), 0.0, made.table);
    const EffectColumns& c = columns.list().back();
    for (int k = 0; k < c.count(); ++k) {
      subset.columns.push_back(c.first + k);
      subset.prior_sigma.push_back(c.parameters[static_cast<std::size_t>(k)].prior_sigma);
      subset.prior_mean.push_back(0.0);
    }
  }
  return fit_model(linearize(made.table, made.truth, {}, columns, {}), subset, {}, options);
}

// The stated covariances hold extrinsic and parameter as often as they say: 60 draws at 95 %, four
// standard deviations of the binomial are ±6.8.
TEST(MixedModel, CoversExtrinsicAndParameter) {
  int extrinsic = 0;
  int parameter = 0;
  constexpr int kDraws = 60;
  for (int draw = 0; draw < kDraws; ++draw) {
    test::TableRecipe recipe;
    recipe.scenes = 5;
    recipe.range_rows = 300;
    recipe.seed = 100 + static_cast<std::uint64_t>(draw);
    test::Disturbance wrong;
    wrong.range_m = [](const BeamPoint& beam) { return 0.006 * beam.darkness; };
    const ModelFit f = fit(test::synthetic_table(recipe, wrong), {"range_walk"});
    const Vector6d x = f.solution.head<6>();
    const Matrix6d c = f.covariance.topLeftCorner<6, 6>();
    extrinsic += x.dot(c.ldlt().solve(x)) < chi_square_gate(6, 0.05) ? 1 : 0;
    const double sigma = std::sqrt(f.covariance(6, 6));
    parameter += std::abs(f.parameters()(0) - 0.006) < 1.96 * sigma ? 1 : 0;
  }
  EXPECT_GE(extrinsic, 57 - 7);
  EXPECT_GE(parameter, 57 - 7);
}

TEST(MixedModel, NoiseScalesAreThoseOfTheRows) {
  test::TableRecipe recipe;
  auto made = test::synthetic_table(recipe);
  for (RangeRow& row : made.table.range) row.sigma_m *= 0.5;  // stated too small
  const ModelFit f = fit(made, {});
  EXPECT_NEAR(f.variances.channel[static_cast<std::size_t>(Channel::kRange)], 4.0, 0.3);
  EXPECT_NEAR(f.variances.channel[static_cast<std::size_t>(Channel::kCorner)], 1.0, 0.25);
  EXPECT_NEAR(f.variances.channel[static_cast<std::size_t>(Channel::kBoundary)], 1.0, 0.2);
}

// Boards that the LiDAR sees up to some millimetres before or behind where the camera does.
test::SyntheticTable with_moved_boards(std::uint64_t seed, double sigma_m) {
  test::TableRecipe recipe;
  recipe.scenes = 10;
  recipe.range_rows = 200;
  recipe.seed = seed;
  auto made = test::synthetic_table(recipe);
  Random random(seed + 7919);
  std::vector<double> moved(10);
  for (double& u : moved) u = sigma_m * random.normal();
  for (RangeRow& row : made.table.range)
    row.measured_m +=
        moved[static_cast<std::size_t>(row.beam.scene)] / std::cos(row.beam.incidence_rad);
  return made;
}

ModelVariances of_moved_boards(double sigma_m) {
  ModelVariances out;
  for (std::size_t k = 0; k < kVarianceGroups; ++k) out.group[k] = kAbsentVariance[k];
  out.group[static_cast<std::size_t>(VarianceGroup::kBoardNormal)] = sigma_m * sigma_m;
  return out;
}

// Motions of whole boards have no weight and are in what is stated: 40 draws at 95 %, four standard
// deviations of the binomial are ±5.5. Without them the boards would be trusted far too much.
TEST(MixedModel, StatedCovarianceHoldsMotionsOfBoards) {
  constexpr double kMoved_m = 0.004;
  constexpr int kDraws = 40;
  int stated = 0;
  int without = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const auto made = with_moved_boards(500 + static_cast<std::uint64_t>(draw), kMoved_m);
    const Linearization linear = linearize(made.table, made.truth, {}, {}, {});
    const ModelVariances variances = of_moved_boards(kMoved_m);
    const auto covers = [](const ModelFit& f) {
      const Vector6d x = f.solution.head<6>();
      const Matrix6d c = f.covariance.topLeftCorner<6, 6>();
      return x.dot(c.ldlt().solve(x)) < chi_square_gate(6, 0.05) ? 1 : 0;
    };
    const StatedVariances stated_with = stated_variances(linear, {}, variances);
    stated += covers(fit_stated(linear, {}, stated_with));
    without += covers(fit_model(linear, {}, stated_with.weights, {.rounds = 0}));
  }
  EXPECT_GE(stated, 38 - 6);
  EXPECT_LT(without, 38 - 6);
}

TEST(MixedModel, StatedFitIsThePlainOneWhereBoardsStandStill) {
  const auto made = test::synthetic_table({});
  const Linearization linear = linearize(made.table, made.truth, {}, {}, {});
  const ModelVariances still = of_moved_boards(1e-6);
  ASSERT_FALSE(moves_boards(still));
  const ModelFit plain = fit_model(linear, {}, still, {.rounds = 0});
  const ModelFit stated = fit_stated(linear, {}, {still, still});
  EXPECT_EQ(stated.solution, plain.solution);
  EXPECT_EQ(stated.covariance, plain.covariance);
}

// Rows that state a third of their noise weigh by what they scatter, and those whose neighbours err
// alike by as much more: variances of 200 rows are known to a tenth.
TEST(MixedModel, StatedFitWeighsEachSceneByItsOwnScatter) {
  auto made = with_moved_boards(3, 1e-3);
  constexpr auto kRange = static_cast<std::size_t>(Channel::kRange);
  const auto weights = [&] {
    const Linearization linear = linearize(made.table, made.truth, {}, {}, {});
    return stated_variances(linear, {}, of_moved_boards(1e-3)).weights;
  };
  const ModelVariances usual = weights();
  EXPECT_FALSE(moves_boards(usual));
  for (std::size_t s = 0; s < 10; ++s) EXPECT_NEAR(usual.channel_of(s)[kRange], 1.0, 0.4) << s;
  for (RangeRow& row : made.table.range) row.sigma_m *= row.beam.scene == 4 ? 1.0 / 3.0 : 1.0;
  made.table.scenes[5].inflation = {1.0, 4.0, 4.0, 4.0};
  const ModelVariances rough = weights();
  EXPECT_NEAR(rough.channel_of(4)[kRange] / usual.channel_of(4)[kRange], 9.0, 0.5);
  EXPECT_NEAR(rough.channel_of(5)[kRange] / usual.channel_of(5)[kRange], 4.0, 0.1);
  EXPECT_NEAR(rough.channel_of(6)[kRange] / usual.channel_of(6)[kRange], 1.0, 0.05);
  // And the fit weighs by them.
  const Linearization linear = linearize(made.table, made.truth, {}, {}, {});
  const ModelFit stated = fit_stated(linear, {}, {rough, of_moved_boards(1e-3)});
  EXPECT_EQ(stated.solution, fit_model(linear, {}, rough, {.rounds = 0}).solution);
  ModelVariances shared = rough;
  shared.scene_channel.clear();
  EXPECT_NE(stated.solution, fit_model(linear, {}, shared, {.rounds = 0}).solution);
}

// Tags that are each shifted as a whole are put down to the tags, not to the corners' noise.
TEST(MixedModel, StructurePerTagIsMeasured) {
  test::Disturbance wrong;
  wrong.corner_px = [](const CornerRow& row) {
    Random random(static_cast<std::uint64_t>(1000 * row.scene + row.feature + 1));
    return test::random_2d(random, 0.3);
  };
  const ModelFit f = fit(test::synthetic_table({}, wrong), {});
  const double sigma =
      std::sqrt(f.variances.group[static_cast<std::size_t>(VarianceGroup::kCornerGroup)]);
  EXPECT_NEAR(sigma, 0.3, 0.05);
  EXPECT_NEAR(f.variances.channel[static_cast<std::size_t>(Channel::kCorner)], 1.0, 0.3);
}

TEST(MixedModel, WithoutStructureTheGroupsVanish) {
  const ModelFit f = fit(test::synthetic_table({}), {});
  EXPECT_LT(std::sqrt(f.variances.group[static_cast<std::size_t>(VarianceGroup::kCornerGroup)]),
            0.02);
  EXPECT_LT(std::sqrt(f.variances.group[static_cast<std::size_t>(VarianceGroup::kRangeShape)]),
            5e-4);
}

TEST(MixedModel, ATrueEffectRaisesThePredictionOfHeldOutScenes) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.004 * beam.darkness; };
  const auto made = test::synthetic_table({}, wrong);
  const ModelFit without = fit(made, {});
  const ModelFit with = fit(made, {"range_walk"});
  for (std::size_t s = 0; s < made.table.scenes.size(); ++s)
    EXPECT_GT(predictive_log_density(with, s), predictive_log_density(without, s)) << s;
}

// Groups at their smallest variance are left out of the fit; a hair above it they are in it.
TEST(MixedModel, GroupsHeldAbsentChangeNothing) {
  const auto made = test::synthetic_table({});
  const Linearization linear = linearize(made.table, made.truth, {}, {}, {});
  ModelVariances absent;
  absent.group = kAbsentVariance;
  ModelVariances barely = absent;
  for (double& v : barely.group) v *= 1.001;
  const ModelFit without = fit_model(linear, {}, absent, {.rounds = 0});
  const ModelFit with = fit_model(linear, {}, barely, {.rounds = 0});
  ASSERT_LT(without.local[0].size(), with.local[0].size());
  for (Eigen::Index k = 0; k < 6; ++k) {
    const double sigma = std::sqrt(with.covariance(k, k));
    EXPECT_NEAR(without.solution(k), with.solution(k), 0.01 * sigma) << k;
    EXPECT_NEAR(std::sqrt(without.covariance(k, k)) / sigma, 1.0, 0.01) << k;
  }
  // What the score test says of them is asked with all of them in the equations.
  const auto of_left_out = group_scores(linear, without);
  EXPECT_GT(of_left_out[0].determined, 0.0);
}

TEST(MixedModel, SquaresWithoutEffectsAreThoseOfTheNoise) {
  const auto made = test::synthetic_table({});
  const Linearization linear = linearize(made.table, made.truth, {}, {}, {});
  const ModelFit f = fit_model(linear, {}, {}, {});
  const auto squares = squares_at(linear, 0, {}, f.solution, f.variances);
  const double rows = linear.scenes[0].rows[static_cast<std::size_t>(Channel::kRange)];
  EXPECT_NEAR(squares[static_cast<std::size_t>(Channel::kRange)], rows,
              5.0 * std::sqrt(2.0 * rows));
}

TEST(MixedModel, SolutionWithoutASceneIgnoresIt) {
  auto made = test::synthetic_table({});
  const ModelFit before = fit(made, {}, {.rounds = 0});
  for (BoundaryRow& row : made.table.boundary) {
    if (row.beam.scene == 2) row.reading.measured += 20.0;
  }
  const ModelFit after = fit(made, {}, {.rounds = 0});
  EXPECT_LT((solution_without(before, 2) - solution_without(after, 2)).norm(), 1e-9);
  EXPECT_GT((before.solution - after.solution).norm(), 1e-5);
}

// What all lines have in common is another effect: told or not told of a common part, the lines'
// own are known, and their sum is zero.
TEST(MixedModel, RunsOfParametersSumToZero) {
  const std::array<double, 6> own = {0.004, -0.006, 0.001, 0.003, -0.004, 0.002};
  for (const double common : {0.0, 0.002}) {
    test::Disturbance wrong;
    wrong.range_m = [&](const BeamPoint& beam) {
      return common + own[static_cast<std::size_t>(beam.line)];
    };
    const auto made = test::synthetic_table({}, wrong);
    EffectColumnsList columns;
    columns.add(find_effect("channel_range_offset"), 0.0, made.table);
    const EffectColumns& c = columns.list().front();
    ASSERT_EQ(c.zero_sums, std::vector<std::size_t>{6});
    ColumnSubset subset;
    for (int k = 0; k < c.count(); ++k) {
      subset.columns.push_back(k);
      subset.prior_sigma.push_back(c.parameters[static_cast<std::size_t>(k)].prior_sigma);
      subset.prior_mean.push_back(0.0);
    }
    subset.zero_sums = {{0, 6}};
    const ModelFit f =
        fit_model(linearize(made.table, made.truth, {}, columns, {}), subset, {}, {});
    EXPECT_NEAR(f.parameters().sum(), 0.0, 1e-4);
    for (Eigen::Index k = 0; k < 6; ++k) {
      const double sigma = std::sqrt(f.covariance(6 + k, 6 + k));
      EXPECT_LT(sigma, 0.0005);
      EXPECT_NEAR(f.parameters()(k), own[static_cast<std::size_t>(k)], 4.0 * sigma);
    }
  }
}

}  // namespace
}  // namespace lvcalib
