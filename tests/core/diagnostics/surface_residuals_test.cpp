// SPDX-License-Identifier: GPL-3.0-or-later
#include "diagnostics/surface_residuals.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "selection/model_session.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

const BoardOutline kBoard{{-0.1, 0.0}, {0.7, 0.4}};

// Returns that scatter by two centimetres about a surface that is 3 mm behind on the right half.
std::vector<SurfaceSample> noisy_step(std::size_t count) {
  Random random(11);
  std::vector<SurfaceSample> out;
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector2d at(random.uniform(-0.1, 0.7), random.uniform(0.0, 0.4));
    out.push_back({at, (at.x() > 0.3 ? 3e-3 : 0.0) + 0.02 * random.normal()});
  }
  return out;
}

TEST(SurfaceResidualsTest, MeansShowWhatSingleReturnsHide) {
  const SurfaceResiduals surface(kBoard, noisy_step(200'000), 0.1);
  for (const double x : {-0.05, 0.25, 0.35, 0.65}) {
    const auto mean = surface.mean_m({x, 0.15});
    ASSERT_TRUE(mean);
    EXPECT_NEAR(*mean, x > 0.3 ? 3e-3 : 0.0, 0.8e-3) << x;
  }
}

TEST(SurfaceResidualsTest, CellsAreAsFineAsTheReturnsAllow) {
  EXPECT_NEAR(SurfaceResiduals(kBoard, noisy_step(2000)).cell_m(), 0.05, 0.01);
  EXPECT_EQ(SurfaceResiduals(kBoard, noisy_step(1'000'000)).cell_m(), 5e-3);
}

TEST(SurfaceResidualsTest, BesideTheBoardAndWhereNothingWasMeasuredThereIsNoMean) {
  const SurfaceResiduals surface(kBoard, {{{0.0, 0.1}, 1e-3}}, 0.05);
  EXPECT_FALSE(surface.mean_m({0.8, 0.1}));
  EXPECT_FALSE(surface.mean_m({0.0, -0.01}));
  EXPECT_FALSE(surface.mean_m({0.6, 0.3}));
  EXPECT_NEAR(surface.mean_m({0.01, 0.11}).value_or(NAN), 1e-3, 1e-12);
  EXPECT_FALSE(SurfaceResiduals(kBoard, {}).mean_m({0.0, 0.1}));
}

TEST(SurfaceResidualsTest, AModelLeavesWhatItDoesNotKnow) {
  test::TableRecipe recipe;
  auto made = test::synthetic_table(recipe);
  const auto far = [](const RangeRow& row) { return row.beam.scene == 1; };
  for (RangeRow& row : made.table.range) row.measured_m += far(row) ? 5e-3 : 0.0;
  const FittedModel model{made.table, made.truth, {}};
  const auto mean = [&](int scene) {
    double sum = 0.0;
    const auto samples = range_samples(model, scene);
    for (const SurfaceSample& s : samples) sum += s.residual_m;
    EXPECT_GT(samples.size(), 100U);
    return sum / static_cast<double>(samples.size());
  };
  EXPECT_NEAR(mean(0), 0.0, 1e-3);
  EXPECT_NEAR(mean(1), 5e-3, 1e-3);
}

}  // namespace
}  // namespace lvcalib
