// SPDX-License-Identifier: GPL-3.0-or-later
#include "discovery/sensitivity_budget.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/pose_matchers.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

const BudgetItem* find(const std::vector<BudgetItem>& budget, const std::string& id) {
  const auto at =
      std::find_if(budget.begin(), budget.end(), [&](const BudgetItem& b) { return b.id == id; });
  return at == budget.end() ? nullptr : &*at;
}

// Boards that hang in the same place, few points, and circles that are hard to see: a range offset
// is a shift of the LiDAR, and nobody can tell.
test::SyntheticTable boards_alike(double offset_m, std::uint64_t seed) {
  test::TableRecipe recipe;
  recipe.alike = true;
  recipe.edge_sigma_m = 0.1;
  recipe.range_rows = 150;
  recipe.seed = seed;
  test::Disturbance wrong;
  wrong.range_m = [offset_m](const BeamPoint&) { return offset_m; };
  return test::synthetic_table(recipe, wrong);
}

TEST(SensitivityBudget, CoversTheErrorOfAnAbsorbedEffect) {
  const DiscoveryOptions options;
  const RunContext context;
  const auto made = boards_alike(0.02, 5);
  EffectSearch search(made.table, made.truth, options, context);
  search.rank();
  ASSERT_FALSE(search.best().has_value());  // absorbed: nothing in the data speaks for it
  const auto budget = sensitivity_budget(search);
  const BudgetItem* offset = find(budget, "range_offset");
  ASSERT_NE(offset, nullptr);
  const Vector6d error =
      se3_log(made.truth.camera_from_lidar * search.state().camera_from_lidar.inverse());
  const Matrix6d stated = search.joint_covariance().topLeftCorner<6, 6>();
  const Matrix6d with = covariance_with_budget(stated, budget);
  // The error along the view, which the covariance of the model alone does not cover in kind.
  const Eigen::Vector3d view = made.truth.camera_from_board[0].translation.normalized();
  const double along = error.head<3>().dot(view);
  EXPECT_GT(std::abs(along), 0.01);
  const Eigen::Matrix3d t = with.topLeftCorner<3, 3>();
  EXPECT_LT(std::abs(along), 2.0 * std::sqrt(view.dot(t * view)));
  EXPECT_GT(offset->translation_mm, 1e3 * std::abs(along));
  EXPECT_GT(offset->size, 20.0);  // mm: the prior's, since the data say nothing
  EXPECT_EQ(offset->unit, "mm");
}

TEST(SensitivityBudget, IsSmallWhereTheScenesShowTheEffect) {
  const DiscoveryOptions options;
  const RunContext context;
  const auto made = test::synthetic_table({});
  EffectSearch search(made.table, made.truth, options, context);
  search.rank();
  const auto budget = sensitivity_budget(search);
  ASSERT_FALSE(budget.empty());
  EXPECT_TRUE(
      std::is_sorted(budget.begin(), budget.end(), [](const BudgetItem& a, const BudgetItem& b) {
        return a.translation_mm > b.translation_mm;
      }));
  const BudgetItem* walk = find(budget, "range_walk");
  ASSERT_NE(walk, nullptr);
  EXPECT_LT(walk->size, 2.0);
  EXPECT_LT(walk->translation_mm, 1.0);
  EXPECT_EQ(find(budget, "angle_zero"), nullptr);  // a gauge is not an error
}

TEST(SensitivityBudget, AddsMomentsToTheCovariance) {
  BudgetItem a;
  a.moment = Vector6d::Unit(0) * Vector6d::Unit(0).transpose() * 4.0;
  BudgetItem b;
  b.moment = Vector6d::Unit(4) * Vector6d::Unit(4).transpose() * 9.0;
  const Matrix6d sum = covariance_with_budget(Matrix6d::Identity(), {a, b});
  EXPECT_EQ(sum(0, 0), 5.0);
  EXPECT_EQ(sum(4, 4), 10.0);
  EXPECT_EQ(sum.trace(), 19.0);
}

TEST(SensitivityBudget, OneParameterMovesByItsLimit) {
  const DiscoveryOptions options;
  const RunContext context;
  const auto made = test::synthetic_table({});
  EffectSearch search(made.table, made.truth, options, context);
  search.rank();
  for (const Candidate& c : search.candidates()) {
    const EffectColumns& columns = search.linear().columns.list()[c.columns];
    if (columns.effect->info().id != "range_scale") continue;
    const double value = c.fit.solution.tail(1)(0);
    const double sigma = std::sqrt(c.fit.covariance.bottomRightCorner(1, 1)(0, 0));
    const BudgetItem* item = find(sensitivity_budget(search), "range_scale");
    ASSERT_NE(item, nullptr);
    const double limit = std::abs(value) + 1.645 * sigma;
    EXPECT_NEAR(item->size, limit / 1e-6, 1e-6 * limit / 1e-6);
    // One σ in the moment, the limit in the list.
    const double ratio = 1e-3 * item->translation_mm / limit;
    const double moment = std::sqrt(item->moment.diagonal().head<3>().sum());
    EXPECT_NEAR(moment, ratio * std::sqrt(value * value + sigma * sigma), 1e-6 * moment);
  }
}

}  // namespace
}  // namespace lvcalib
