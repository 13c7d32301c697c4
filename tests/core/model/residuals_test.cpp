// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/residuals.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/statistics.h"
#include "model/scene_geometry.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

TEST(Residuals, AtTheTruthAreTheNoise) {
  const auto made = test::synthetic_table({});
  const double sigma[kChannels] = {0.05, 0.008, 0.0005, 0.2};
  for (const Channel channel : kAllChannels) {
    const auto r = residuals_of(made.table, made.truth, {}, channel);
    const std::size_t per_row = channel == Channel::kCorner ? 2 : 1;
    ASSERT_EQ(r.values.size(), per_row * made.table.size(channel));
    EXPECT_EQ(r.sigma.size(), r.values.size());
    EXPECT_EQ(r.scene.size(), r.values.size());
    EXPECT_EQ(r.row.size(), r.values.size());
    EXPECT_TRUE(r.nuisance.empty());
    const auto more = residuals_and_nuisance(made.table, made.truth, {}, channel);
    EXPECT_EQ(more.values, r.values);
    EXPECT_EQ(more.nuisance.size(), r.values.size());
    const double expected = sigma[static_cast<std::size_t>(channel)];
    // Six standard errors of an RMS.
    const double error = 6.0 * expected / std::sqrt(2.0 * static_cast<double>(r.values.size()));
    EXPECT_NEAR(rms(r.values), expected, error) << name_of(channel);
    EXPECT_EQ(r.sigma.front(), expected) << name_of(channel);
  }
}

TEST(Residuals, AreMeasuredMinusPredicted) {
  auto made = test::synthetic_table({});
  const auto before = residuals_of(made.table, made.truth, {}, Channel::kRange);
  made.table.range[5].measured_m += 0.01;
  const auto after = residuals_of(made.table, made.truth, {}, Channel::kRange);
  EXPECT_NEAR(after.values[5] - before.values[5], 0.01, 1e-12);
  EXPECT_EQ(after.values[6], before.values[6]);
}

TEST(Residuals, LoseWhatTheEffectsInUseExplain) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.02 + 0.003 * beam.range_m; };
  const auto made = test::synthetic_table({}, wrong);
  const std::vector<EffectInUse> in_use = {
      {find_effect("range_offset"), 0.0, Eigen::VectorXd::Constant(1, 0.02)},
      {find_effect("range_scale"), 0.0, Eigen::VectorXd::Constant(1, 0.003)}};
  EXPECT_GT(rms(residuals_of(made.table, made.truth, {}, Channel::kRange).values), 0.025);
  EXPECT_NEAR(rms(residuals_of(made.table, made.truth, in_use, Channel::kRange).values), 0.008,
              0.0004);
}

TEST(Residuals, EdgesMovedSidewaysByCentimetresLeaveNoCurvature) {
  // Every edge point is seen 12 mm to the left of its place (a beam that starts there): with the
  // effect in use nothing is left, although 12 mm along a circle of 45 mm are 0.8 mm off it.
  test::TableRecipe recipe;
  recipe.edge_sigma_m = 1e-9;
  auto made = test::synthetic_table(recipe);
  constexpr double kSideways = 0.012;
  for (BoundaryRow& row : made.table.boundary) {
    const SceneGeometry g(made.truth.camera_from_lidar,
                          made.truth.camera_from_board[static_cast<std::size_t>(row.beam.scene)]);
    const Eigen::Vector3d left =
        Eigen::Vector3d::UnitZ().cross(row.beam.direction).normalized() * kSideways;
    const Eigen::Vector3d seen = row.beam.range_m * row.beam.direction + left;
    ASSERT_TRUE(g.describe(seen.normalized(), row.beam));
  }
  const std::vector<EffectInUse> in_use = {
      {find_effect("beam_origin_offset"), 0.0, Eigen::Vector2d(kSideways, 0.0)}};
  EXPECT_GT(rms(residuals_of(made.table, made.truth, {}, Channel::kBoundary).values), 1e-3);
  const auto left = residuals_of(made.table, made.truth, in_use, Channel::kBoundary);
  EXPECT_LT(rms(left.values), 1e-4);
}

TEST(Residuals, CornersOutsideTheCamerasReachAreLeftOut) {
  auto made = test::synthetic_table({});
  ModelState turned = made.truth;
  turned.camera_from_board[0].translation.z() = -3.0;  // behind the camera
  const auto all = residuals_of(made.table, made.truth, {}, Channel::kCorner);
  const auto some = residuals_of(made.table, turned, {}, Channel::kCorner);
  EXPECT_EQ(all.values.size() - some.values.size(), 128U);
  for (const int scene : some.scene) EXPECT_NE(scene, 0);
}

TEST(Residuals, IntensityRefersToTheLevelOfItsPrint) {
  const auto made = test::synthetic_table({});
  const auto r = residuals_and_nuisance(made.table, made.truth, {}, Channel::kIntensity);
  for (std::size_t k = 0; k < 50; ++k) {
    const IntensityRow& row = made.table.intensity[r.row[k]];
    const double level = row.print == Print::kWhite ? 100.0 : 10.0;
    // A thousandth of the contrast is what a blurred print may be off.
    EXPECT_NEAR(r.values[k], row.reading.measured / level - 1.0, 0.1 / level);
    EXPECT_NEAR(level * r.nuisance[k](LocalLayout::kPose + static_cast<int>(row.print)), 1.0, 0.01);
    EXPECT_NEAR(level * r.nuisance[k].segment<2>(LocalLayout::kPose).sum(), 1.0, 0.01);
  }
}

}  // namespace
}  // namespace lvcalib
