// SPDX-License-Identifier: GPL-3.0-or-later
#include "diagnostics/binned_residuals.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "base/random.h"

namespace lvcalib {
namespace {

struct Columns {
  std::vector<float> x, y, value, sigma;
  std::vector<int> scene;
  [[nodiscard]] ResidualSample sample() const { return {value, sigma, scene}; }
};

Columns noise(std::size_t n, int scenes, std::uint64_t seed, double scene_shift = 0.0) {
  Random random(seed);
  Columns c;
  std::vector<double> shift;
  for (int s = 0; s < scenes; ++s) shift.push_back(scene_shift * random.normal());
  for (std::size_t k = 0; k < n; ++k) {
    const int s = static_cast<int>(k % static_cast<std::size_t>(scenes));
    c.x.push_back(static_cast<float>(random.uniform(0.0, 1.0)));
    c.y.push_back(static_cast<float>(random.uniform(0.0, 2.0)));
    c.sigma.push_back(2.0F);
    c.scene.push_back(s);
    c.value.push_back(
        static_cast<float>(2.0 * random.normal() + shift[static_cast<std::size_t>(s)]));
  }
  return c;
}

std::vector<std::size_t> all_rows(const Columns& c) {
  std::vector<std::size_t> rows(c.value.size());
  std::iota(rows.begin(), rows.end(), 0U);
  return rows;
}

TEST(MeanResidualTest, WhiteNoiseHasTheTextbookDeviation) {
  const Columns c = noise(4000, 1, 3);
  const MeanResidual m = mean_residual(c.sample(), all_rows(c), 1);
  EXPECT_NEAR(m.sigma, 2.0 / std::sqrt(4000.0), 0.002);
  EXPECT_EQ(m.n, 4000U);
  EXPECT_LT(std::abs(m.mean), 4.0 * m.sigma);
}

TEST(MeanResidualTest, ScenesThatErrTogetherWidenIt) {
  const Columns c = noise(6000, 6, 5, 1.0);
  const MeanResidual m = mean_residual(c.sample(), all_rows(c), 1);
  EXPECT_GT(m.sigma, 5.0 * 2.0 / std::sqrt(6000.0)) << "six scenes, not six thousand residuals";
  EXPECT_FALSE(m.significant);
}

TEST(MeanResidualTest, TheDeviationHoldsOverManyDraws) {
  int significant = 0;
  double squares = 0.0;
  constexpr int kDraws = 200;
  for (int seed = 1; seed <= kDraws; ++seed) {
    const Columns c = noise(120, 8, static_cast<std::uint64_t>(seed), 0.5);
    const MeanResidual m = mean_residual(c.sample(), all_rows(c), 1);
    significant += m.significant ? 1 : 0;
    squares += std::pow(m.mean / m.sigma, 2);
  }
  EXPECT_LE(significant, 20) << "5 % of 200 is 10";
  EXPECT_NEAR(squares / kDraws, 1.0, 0.35);
}

TEST(BinResiduals, AStepIsFoundWhereItIs) {
  Columns c = noise(6000, 6, 7);
  for (std::size_t k = 0; k < c.x.size(); ++k) {
    if (c.x[k] > 0.5F) c.value[k] += 3.0F;
  }
  const auto bins = bin_residuals(c.x, false, c.sample(), 10);
  ASSERT_EQ(bins.size(), 10U);
  for (const ResidualBin& bin : bins) {
    if (bin.center < 0.45) {
      EXPECT_FALSE(bin.residual.significant);
    } else if (bin.center > 0.55) {
      EXPECT_TRUE(bin.residual.significant);
      EXPECT_NEAR(bin.residual.mean, 3.0, 5.0 * bin.residual.sigma);
    }
  }
}

TEST(BinResiduals, WhiteNoiseIsRarelySignificantAnywhere) {
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Columns c = noise(2000, 6, seed);
    for (const ResidualBin& bin : bin_residuals(c.x, false, c.sample(), 20)) {
      if (!bin.residual.significant) continue;
      ++alarms;
      break;
    }
  }
  EXPECT_LE(alarms, 12) << "of 100; 5 expected";
}

TEST(BinResiduals, LabelsAreOneGroupEachAndTiesStayTogether) {
  Columns c = noise(900, 3, 9);
  for (std::size_t k = 0; k < c.x.size(); ++k) c.x[k] = static_cast<float>(k % 3);
  const auto bins = bin_residuals(c.x, true, c.sample());
  ASSERT_EQ(bins.size(), 3U);
  for (const ResidualBin& bin : bins) EXPECT_EQ(bin.residual.n, 300U);
  EXPECT_EQ(bin_residuals(c.x, false, c.sample(), 100).size(), 3U);
}

TEST(BinResiduals, ValuesThatAreNotThereAreLeftOut) {
  Columns c = noise(100, 3, 11);
  for (std::size_t k = 0; k < 50; ++k) c.x[k] = NAN;
  std::size_t rows = 0;
  for (const ResidualBin& bin : bin_residuals(c.x, false, c.sample(), 4)) rows += bin.residual.n;
  EXPECT_EQ(rows, 50U);
  EXPECT_TRUE(bin_residuals({}, false, {}, 4).empty());
}

TEST(MapResiduals, ACornerOfThePlaneStandsOut) {
  Columns c = noise(20000, 6, 13);
  for (std::size_t k = 0; k < c.x.size(); ++k) {
    if (c.x[k] > 0.8F && c.y[k] > 1.6F) c.value[k] += 4.0F;
  }
  const ResidualMap map = map_residuals(c.x, c.y, {}, c.sample(), 10);
  EXPECT_EQ(map.columns, 5);
  EXPECT_EQ(map.rows, 10);
  int marked = 0;
  for (const ResidualCell& cell : map.cells) {
    if (!cell.significant()) continue;
    ++marked;
    EXPECT_GT(cell.x, 0.8);
    EXPECT_GT(cell.y, 1.5);
    EXPECT_NEAR(cell.first.mean, 4.0, 0.6);
  }
  EXPECT_GE(marked, 2);
}

TEST(MapResiduals, ArrowsHaveTwoComponents) {
  Columns c = noise(4000, 4, 17);
  std::vector<int> component;
  for (std::size_t k = 0; k < c.x.size(); ++k) {
    component.push_back(static_cast<int>((k / 4) % 2));
    if (component.back() == 1) c.value[k] += 5.0F;
  }
  const ResidualMap map = map_residuals(c.x, c.y, component, c.sample(), 4);
  ASSERT_FALSE(map.cells.empty());
  for (const ResidualCell& cell : map.cells) {
    EXPECT_NEAR(cell.first.mean, 0.0, 5.0 * cell.first.sigma);
    EXPECT_NEAR(cell.second.mean, 5.0, 5.0 * cell.second.sigma);
  }
  EXPECT_TRUE(map_residuals({}, {}, {}, {}, 4).cells.empty());
}

}  // namespace
}  // namespace lvcalib
