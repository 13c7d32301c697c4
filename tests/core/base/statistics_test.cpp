// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/statistics.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"

namespace lvcalib {
namespace {

TEST(Statistics, QuantilesInterpolateBetweenOrderStatistics) {
  EXPECT_EQ(quantile({3, 1, 2}, 0.0), 1);
  EXPECT_EQ(quantile({3, 1, 2}, 0.5), 2);
  EXPECT_EQ(quantile({3, 1, 2}, 1.0), 3);
  EXPECT_NEAR(quantile({4, 1, 3, 2}, 0.5), 2.5, 1e-15);
  EXPECT_NEAR(quantile({0, 10}, 0.25), 2.5, 1e-15);
  EXPECT_EQ(quantile({5}, 0.7), 5);
  EXPECT_EQ(quantile({1, 2}, -1), 1);
  EXPECT_EQ(quantile({1, 2}, 2), 2);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
  EXPECT_TRUE(std::isnan(median({})));
  EXPECT_TRUE(std::isnan(mad_sigma({})));
}

TEST(Statistics, MadSigmaIsTheStandardDeviationAndIgnoresOutliers) {
  Random random(1);
  std::vector<double> values;
  for (int i = 0; i < 20'000; ++i) values.push_back(random.normal(5.0, 2.0));
  EXPECT_NEAR(median(values), 5.0, 0.06);
  EXPECT_NEAR(mad_sigma(values), 2.0, 0.06);
  for (int i = 0; i < 2'000; ++i) values.push_back(1e6);
  EXPECT_NEAR(mad_sigma(values), 2.0, 0.35);
}

TEST(Statistics, BoxSummaryOfKnownValues) {
  const BoxSummary box = box_summary({9, 2, 1, 3, 4, 5, 6, 7, 8, 100, NAN});
  EXPECT_EQ(box.count, 10U);
  EXPECT_NEAR(box.median, 5.5, 1e-12);
  EXPECT_NEAR(box.lower_quartile, 3.25, 1e-12);
  EXPECT_NEAR(box.upper_quartile, 7.75, 1e-12);
  EXPECT_EQ(box.lower_whisker, 1);
  EXPECT_EQ(box.upper_whisker, 9);
  EXPECT_EQ(box.outliers, std::vector<double>{100});
  EXPECT_EQ(box_summary({}).count, 0U);
  EXPECT_EQ(box_summary({2}).upper_whisker, 2);
}

// Of Gaussian values 0.7 % lie beyond the whiskers.
TEST(Statistics, BoxSummaryOfGaussianValues) {
  Random random(2);
  std::vector<double> values;
  for (int i = 0; i < 50'000; ++i) values.push_back(random.normal());
  const BoxSummary box = box_summary(values);
  EXPECT_NEAR(box.upper_quartile, 0.6745, 0.02);
  EXPECT_NEAR(static_cast<double>(box.outliers.size()) / 50'000.0, 0.00698, 0.0015);
}

TEST(Statistics, RmsOfKnownValues) {
  const std::vector<double> values{3, -4};
  EXPECT_NEAR(rms(values), std::sqrt(12.5), 1e-15);
  EXPECT_EQ(rms({}), 0.0);
}

TEST(Statistics, RobustWeightsFollowTheirLosses) {
  // w(r) = ρ'(r)/r, with ρ from the definitions, differentiated numerically.
  const double k = 1.345;
  const auto huber = [k](double r) {
    return std::abs(r) <= k ? 0.5 * r * r : k * (std::abs(r) - 0.5 * k);
  };
  const double c = 4.685;
  const auto tukey = [c](double r) {
    const double u = std::min(1.0, r * r / (c * c));
    return c * c / 6 * (1 - std::pow(1 - u, 3));
  };
  for (const double r : {0.1, 1.0, 1.3, 2.0, 4.0, 6.0}) {
    const double h = 1e-6;
    EXPECT_NEAR(huber_weight(r), (huber(r + h) - huber(r - h)) / (2 * h * r), 1e-6);
    EXPECT_NEAR(tukey_weight(r), (tukey(r + h) - tukey(r - h)) / (2 * h * r), 1e-6);
    EXPECT_EQ(huber_weight(-r), huber_weight(r));
    EXPECT_EQ(tukey_weight(-r), tukey_weight(r));
  }
  EXPECT_EQ(huber_weight(0), 1.0);
  EXPECT_EQ(tukey_weight(0), 1.0);
  EXPECT_EQ(tukey_weight(5), 0.0);
}

TEST(Statistics, NormalDistributionAgreesWithTables) {
  EXPECT_NEAR(normal_cdf(0), 0.5, 1e-15);
  EXPECT_NEAR(normal_cdf(1.959963985), 0.975, 1e-9);
  EXPECT_NEAR(normal_cdf(-3), 0.0013498980316, 1e-12);
  double worst = 0.0;
  double worst_share = 0.0;
  for (double x = -9.0; x < 9.0; x += 0.000917) {
    const double exact = 0.5 * std::erfc(-x / std::sqrt(2.0));
    worst = std::max(worst, std::abs(normal_cdf(x) - exact));
    worst_share = std::max(worst_share, std::abs(normal_cdf(x) / exact - 1.0));
  }
  EXPECT_LT(worst, 2e-13);
  EXPECT_LT(worst_share, 1e-9);
  EXPECT_NEAR(normal_pdf(0), 0.3989422804014327, 1e-15);
  EXPECT_NEAR(normal_pdf(1.5), (normal_cdf(1.5 + 1e-5) - normal_cdf(1.5 - 1e-5)) / 2e-5, 1e-8);
}

TEST(Statistics, NormalQuantileIsTheInverse) {
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 2e-15);
  EXPECT_NEAR(normal_quantile(1e-9), -5.997807015007687, 6e-15);
  EXPECT_EQ(normal_quantile(0.5), 0.0);
  for (double x = -8.0; x <= 5.0; x += 0.0137) {
    const double p = 0.5 * std::erfc(-x / std::sqrt(2.0));
    // Near one, a p of double precision says no more of x.
    const double told = 1e-16 * (1.0 + std::max(0.0, 1.0 / normal_pdf(x) - 3.0));
    EXPECT_NEAR(normal_quantile(p), x, 2e-14 + 2.0 * told) << x;
  }
}

TEST(Statistics, ChiSquareGateAgreesWithTables) {
  // From printed tables, to the digits that are there.
  const struct {
    int degrees;
    double tail;
    double value;
  } table[] = {{1, 0.05, 3.841},   {2, 0.05, 5.991},  {6, 0.05, 12.592},  {10, 0.05, 18.307},
               {2, 0.01, 9.210},   {6, 0.01, 16.812}, {30, 0.01, 50.892}, {100, 0.05, 124.342},
               {1, 0.001, 10.828}, {1, 1e-4, 15.137}, {6, 1e-4, 27.856}};
  for (const auto& row : table) {
    EXPECT_NEAR(chi_square_gate(row.degrees, row.tail), row.value, 6e-4);
  }
  // Of two degrees the tail is exp(−χ²/2), however far out.
  EXPECT_NEAR(chi_square_gate(2, 1e-12), -2.0 * std::log(1e-12), 1e-9);
  // Without a degree of freedom there is no gate, and nothing passes a comparison with it.
  EXPECT_TRUE(std::isnan(chi_square_gate(0, 0.01)));
}

TEST(Statistics, GatesOfEstimatedNoise) {
  // Tables of F: 5 % and 1 %.
  EXPECT_NEAR(f_gate(1, 1.0, 0.05), 161.448, 1e-2);
  EXPECT_NEAR(f_gate(3, 10.0, 0.05), 3.0 * 3.7083, 1e-3);
  EXPECT_NEAR(f_gate(8, 8.0, 0.01), 8.0 * 6.0289, 1e-3);
  EXPECT_NEAR(f_gate(5, 1e9, 1e-3), chi_square_gate(5, 1e-3), 1e-4);
  EXPECT_TRUE(std::isinf(f_gate(5, 0.0, 1e-3)));
}

TEST(Statistics, TailsAgreeWithTables) {
  EXPECT_NEAR(f_tail(3, 10.0, 3.7083), 0.05, 1e-5);
  EXPECT_NEAR(f_tail(8, 8.0, 6.0289), 0.01, 1e-6);
  EXPECT_TRUE(std::isnan(f_tail(6, 10.0, std::nan(""))));
  EXPECT_NEAR(student_gate(1.0, 0.025), 12.7062, 1e-4);
  EXPECT_NEAR(student_gate(10.0, 0.005), 3.1693, 1e-4);
  // Three or more where one is expected: 1 − (1 + 1 + 1/2)/e.
  EXPECT_NEAR(poisson_tail(3.0, 1.0), 1.0 - 2.5 * std::exp(-1.0), 1e-14);
}

}  // namespace
}  // namespace lvcalib
