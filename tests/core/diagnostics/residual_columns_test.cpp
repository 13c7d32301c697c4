// SPDX-License-Identifier: GPL-3.0-or-later
#include "diagnostics/residual_columns.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "selection/model_session.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

double rms_of(const std::vector<float>& values) {
  double sum = 0.0;
  for (const float v : values) sum += static_cast<double>(v) * static_cast<double>(v);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

class ColumnsOfResiduals : public ::testing::Test {
 protected:
  ColumnsOfResiduals() {
    test::Disturbance wrong;
    wrong.range_m = [](const BeamPoint& beam) { return 0.008 * beam.darkness; };
    auto made = test::synthetic_table({}, wrong);
    truth_ = made.truth;
    base_ = *start_model(std::move(made.table), truth_, {}, {});
    walk_ = *add_effect(base_, "range_walk", 0.0, {});
  }
  ModelState truth_;
  ModelStepPtr base_, walk_;
};

TEST_F(ColumnsOfResiduals, BeforeAndAfterStandSideBySide) {
  const ResidualColumns c = residual_columns(walk_->fitted(), base_->fitted(), Channel::kRange);
  ASSERT_EQ(c.size(), base_->table().range.size());
  ASSERT_EQ(c.before.size(), c.size());
  EXPECT_TRUE(c.component.empty());
  EXPECT_NEAR(rms_of(c.value), 8.0, 0.3) << "millimetres: the noise";
  EXPECT_GT(rms_of(c.before), 8.6);
  const Covariate* darkness = c.find("darkness");
  ASSERT_NE(darkness, nullptr);
  EXPECT_EQ(c.find("no such thing"), nullptr);
  const auto before = bin_residuals(darkness->values, true, c.sample_before());
  ASSERT_EQ(before.size(), 2U);
  EXPECT_NEAR(before[1].residual.mean - before[0].residual.mean, 8.0, 0.8);
  const auto after = bin_residuals(darkness->values, true, c.sample());
  EXPECT_NEAR(after[1].residual.mean - after[0].residual.mean, 0.0, 0.8);
  EXPECT_FALSE(after[1].residual.significant);
}

TEST_F(ColumnsOfResiduals, CornersHaveTwoComponents) {
  const ResidualColumns c = residual_columns(base_->fitted(), base_->fitted(), Channel::kCorner);
  ASSERT_EQ(c.size(), 2 * base_->table().corner.size());
  EXPECT_THAT(c.component, Contains(0));
  EXPECT_THAT(c.component, Contains(1));
  EXPECT_EQ(c.before, c.value);
}

TEST_F(ColumnsOfResiduals, ThePatternOfAnEffectIsWhatItAdds) {
  EffectInUse use{find_effect("range_walk"), 0.0, Eigen::VectorXd::Constant(1, 0.005)};
  const auto raw = effect_pattern(base_->fitted(), use, Channel::kRange, false);
  const auto& rows = base_->table().range;
  ASSERT_EQ(raw.size(), rows.size());
  for (std::size_t k = 0; k < raw.size(); k += 97)
    EXPECT_NEAR(static_cast<double>(raw[k]), 5.0 * rows[k].beam.darkness, 1e-3);
  // The extrinsic takes over a turn of the LiDAR's axes, which then leaves no pattern.
  const EffectPtr turn = find_effect("angle_zero");
  const auto n = static_cast<Eigen::Index>(turn->parameters(base_->table()).size());
  EffectInUse turned{turn, 0.0, Eigen::VectorXd::Constant(n, 1e-4)};
  const double whole = rms_of(effect_pattern(walk_->fitted(), turned, Channel::kBoundary, false));
  EXPECT_GT(whole, 0.1);
  EXPECT_LT(rms_of(effect_pattern(walk_->fitted(), turned, Channel::kBoundary, true)), 0.1 * whole);
  // Linear in the size.
  use.values *= 2.0;
  const auto twice = effect_pattern(base_->fitted(), use, Channel::kRange, true);
  use.values *= 0.5;
  const auto once = effect_pattern(base_->fitted(), use, Channel::kRange, true);
  for (std::size_t k = 0; k < once.size(); k += 131)
    EXPECT_NEAR(static_cast<double>(twice[k]), 2.0 * static_cast<double>(once[k]), 1e-3);
}

TEST_F(ColumnsOfResiduals, ThePatternAtItsEstimateIsWhatIsSeen) {
  const EffectInUse found = walk_->terms[0].use;
  const auto predicted = effect_pattern(base_->fitted(), found, Channel::kRange, true);
  const ResidualColumns c = residual_columns(base_->fitted(), base_->fitted(), Channel::kRange);
  const Covariate* darkness = c.find("darkness");
  ASSERT_NE(darkness, nullptr);
  const auto seen = bin_residuals(darkness->values, true, c.sample());
  const auto model = bin_residuals(darkness->values, true, {predicted, c.sigma, c.scene});
  ASSERT_EQ(seen.size(), model.size());
  for (std::size_t k = 0; k < seen.size(); ++k)
    EXPECT_NEAR(seen[k].residual.mean, model[k].residual.mean, 5.0 * seen[k].residual.sigma + 0.3);
  const double step_seen = seen[1].residual.mean - seen[0].residual.mean;
  EXPECT_NEAR(model[1].residual.mean - model[0].residual.mean, step_seen, 0.1 * step_seen);
}

TEST_F(ColumnsOfResiduals, AnEffectShowsInItsChannelsOnly) {
  EXPECT_THAT(channels_of(*find_effect("corner_bias"), 0.0, base_->fitted()),
              ElementsAre(Channel::kCorner));
  const auto walk = channels_of(*find_effect("range_walk"), 0.0, base_->fitted());
  EXPECT_THAT(walk, Contains(Channel::kRange));
  EXPECT_THAT(walk, Not(Contains(Channel::kCorner)));
  EXPECT_THAT(channels_of(*find_effect("board_bow"), 0.0, base_->fitted()),
              Contains(Channel::kRange));
}

}  // namespace
}  // namespace lvcalib
