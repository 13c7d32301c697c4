// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/fit_inference.h"

#include <gtest/gtest.h>

#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

TEST(DeterminedShare, IsWhatNothingElseDoesOfAnEffect) {
  const auto made = test::synthetic_table({});
  EffectColumnsList columns;
  for (const char* id : {"range_scale", "range_scale", "range_walk"})
    columns.add(find_effect(id), 0.0, made.table);
  const Linearization linear = linearize(made.table, made.truth, {}, columns, {});
  ColumnSubset subset;
  for (const EffectColumns& c : columns.list()) append_columns(c, nullptr, subset);
  const ModelFit fit = fit_model(linear, subset, {}, {.rounds = 0});
  EXPECT_LT(determined_share(fit, 6, 1), 1e-6);  // its twin is in the model
  EXPECT_LT(determined_share(fit, 7, 1), 1e-6);
  EXPECT_GT(determined_share(fit, 8, 1), 0.01);
  EXPECT_LE(determined_share(fit, 8, 1), 1.0);
}

// By hand: one unknown beside the extrinsic, known through the same row as the origin's x.
TEST(UnabsorbedShare, IsWhatTheExtrinsicCannotTakeOver) {
  ModelFit fit;
  fit.prior.information = Eigen::MatrixXd::Zero(7, 7);
  fit.prior.information(6, 6) = 1e9;  // The effect's own prior is no evidence.
  Eigen::MatrixXd h = Eigen::MatrixXd::Identity(7, 7);
  h(0, 6) = h(6, 0) = 0.6;  // Σ x·e, with Σ x² = Σ e² = 1: 0.36 of the squares are absorbed.
  fit.scenes = {{h, Eigen::VectorXd::Zero(7), 0.0}};
  const Eigen::VectorXd values = Eigen::VectorXd::Constant(1, 2e-3);
  EXPECT_NEAR(unabsorbed_share(fit, values), 0.64, 1e-12);
  const ExtrinsicMove move = move_if_omitted(fit, values);
  EXPECT_NEAR(move.translation_m, 0.6 * 2e-3, 1e-12);
  EXPECT_NEAR(move.rotation_rad, 0.0, 1e-12);
  EXPECT_EQ(unabsorbed_share(fit, Eigen::VectorXd::Zero(1)), 0.0);
}

TEST(Tolerated, IsTheUsersOrWhatIsLeftOpenAnyway) {
  ModelFit fit;
  fit.covariance = Eigen::MatrixXd::Zero(6, 6);
  fit.covariance.diagonal() << 4e-6, 1e-6, 1e-6, 1e-8, 9e-8, 1e-8;  // 2 mm and 0.3 mrad at worst
  const ExtrinsicMove usual = tolerated({}, fit);
  EXPECT_NEAR(usual.translation_m, 1e-3, 1e-9);
  EXPECT_NEAR(usual.rotation_rad, 2e-4, 1e-9);
  const ExtrinsicMove own = tolerated({{1e-4, 1e-5}, 0.0}, fit);
  EXPECT_NEAR(own.translation_m, 1e-4, 1e-12);
  EXPECT_NEAR(own.rotation_rad, 1e-5, 1e-12);
  EXPECT_TRUE(usual.exceeds(own));
  EXPECT_NEAR(usual.over(own), 20.0, 1e-6);
}

TEST(IsGain, MeansMoreThanOneStandardError) {
  EXPECT_TRUE(is_gain({1.0, 1.2, 0.8}));
  EXPECT_FALSE(is_gain({3.0, -1.5, -1.0}));
  EXPECT_FALSE(is_gain({-1.0, -1.0, -1.1}));
  EXPECT_FALSE(is_gain({5.0}));  // one scene has no standard error
}

}  // namespace
}  // namespace lvcalib
