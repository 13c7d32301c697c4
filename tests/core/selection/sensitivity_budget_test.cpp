// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/sensitivity_budget.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "selection/effect_search.h"
#include "support/pose_matchers.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

const BudgetItem* find(const std::vector<BudgetItem>& budget, const std::string& id) {
  const auto at =
      std::find_if(budget.begin(), budget.end(), [&](const BudgetItem& b) { return b.id == id; });
  return at == budget.end() ? nullptr : &*at;
}

// Boards that all hang in one place, and a principal point that is off: the rig turns and follows.
test::SyntheticTable principal_point_off(double off_px, std::uint64_t seed) {
  test::TableRecipe recipe;
  recipe.alike = true;
  recipe.range_rows = 300;
  recipe.seed = seed;
  test::Disturbance wrong;
  wrong.corner_px = [off_px](const CornerRow&) { return Eigen::Vector2d(off_px, 0.0); };
  return test::synthetic_table(recipe, wrong);
}

TEST(SensitivityBudget, CoversTheErrorOfAnEffectThatIsLeftOut) {
  const DiscoveryOptions options;
  const RunContext context;
  constexpr double kChiSquare95 = 12.6;  // six degrees of freedom
  for (const double off_px : {0.5, 3.0}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const auto made = principal_point_off(off_px, seed);
      EffectSearch search(made.table, made.truth, options, context);
      search.rank();
      const auto budget = sensitivity_budget(search);
      const Vector6d error =
          se3_log(made.truth.camera_from_lidar * search.state().camera_from_lidar.inverse());
      const Matrix6d stated = search.joint_covariance().topLeftCorner<6, 6>();
      const Matrix6d with = covariance_with_budget(stated, budget);
      EXPECT_GT(error.dot(stated.ldlt().solve(error)), 100.0) << off_px;
      EXPECT_LT(error.dot(with.ldlt().solve(error)), kChiSquare95) << off_px;
      const BudgetItem* intrinsics = find(budget, "intrinsics_error");
      ASSERT_NE(intrinsics, nullptr);
      EXPECT_GT(intrinsics->size, off_px);
      EXPECT_GT(intrinsics->rotation_mrad, 1e3 * error.tail<3>().norm());
      EXPECT_EQ(intrinsics->unit, "px");
    }
  }
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
    const auto budget = sensitivity_budget(search);
    const BudgetItem* item = find(budget, "range_scale");
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
