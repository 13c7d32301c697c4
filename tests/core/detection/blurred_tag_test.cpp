// SPDX-License-Identifier: GPL-3.0-or-later
#include "detection/blurred_tag.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "base/random.h"

namespace lvcalib {
namespace {

// Albedo once all black has grown by g, or white where g is negative; sharp corners.
double grown_albedo(const BlurredTag& tag, const Eigen::Vector2d& p, double g) {
  double out = tag.albedo(p.x(), p.y());
  for (const double du : {-g, 0.0, g}) {
    for (const double dv : {-g, 0.0, g}) {
      const double beside = tag.albedo(p.x() + du, p.y() + dv);
      out = g > 0.0 ? std::min(out, beside) : std::max(out, beside);
    }
  }
  return out;
}

// The convolution by brute force: mean over a grid of ±4.5 σ.
double convolved(const BlurredTag& tag, double u, double v, const TagBlur& blur, double g = 0.0) {
  const Eigen::Matrix2d covariance{{blur.uu, blur.uv}, {blur.uv, blur.vv}};
  const Eigen::Matrix2d root = covariance.llt().matrixL();
  double sum = 0.0, weights = 0.0;
  for (double a = -4.5; a <= 4.5; a += 0.03) {
    for (double b = -4.5; b <= 4.5; b += 0.03) {
      const double weight = std::exp(-0.5 * (a * a + b * b));
      const Eigen::Vector2d p = Eigen::Vector2d(u, v) + root * Eigen::Vector2d(a, b);
      sum += weight * grown_albedo(tag, p, g);
      weights += weight;
    }
  }
  return sum / weights;
}

TEST(BlurredTag, UnblurredCellsFollowThePattern) {
  const TagPattern& pattern = *tag_pattern("tag36h11", 5);
  const BlurredTag tag(pattern, 2);
  EXPECT_EQ(tag.side(), 10);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      const double u = -1 + tag.cell() * (column + 2.5);
      const double v = 1 - tag.cell() * (row + 2.5);
      EXPECT_EQ(tag.albedo(u, v) > 0.5, pattern.at(row, column));
    }
  }
  EXPECT_EQ(tag.albedo(-0.99, 0.0), 0.0);
  EXPECT_EQ(tag.albedo(-1.01, 0.0), 1.0);
}

TEST(BlurredTag, EqualsTheConvolution) {
  BlurredTag tag(*tag_pattern("tag36h11", 12), 1);
  tag.set_quadrant(2, 0.0);
  Random random(3);
  for (int i = 0; i < 25; ++i) {
    const double u = random.uniform(-1.2, 1.2);
    const double v = random.uniform(-1.2, 1.2);
    const double su = random.uniform(0.02, 0.12);
    const double sv = random.uniform(0.02, 0.12);
    const double correlation = random.uniform(-0.35, 0.35);
    const TagBlur blur{su * su, correlation * su * sv, sv * sv};
    EXPECT_NEAR(tag.sample(u, v, blur).value, convolved(tag, u, v, blur), 0.008);
  }
}

TEST(BlurredTag, EdgesAreWhatGrowingBlackTakesAway) {
  constexpr double kGrowth = 0.01;
  const BlurredTag tag(*tag_pattern("tag36h11", 12), 1);
  Random random(6);
  for (int i = 0; i < 25; ++i) {
    const double u = random.uniform(-1.1, 1.1);
    const double v = random.uniform(-1.1, 1.1);
    const double sigma = random.uniform(0.06, 0.16);
    const TagBlur blur{sigma * sigma, 0.0, sigma * sigma};
    const double taken =
        (convolved(tag, u, v, blur, -kGrowth) - convolved(tag, u, v, blur, kGrowth)) /
        (2.0 * kGrowth);
    const TagSample here = tag.sample(u, v, blur);
    // Two bits that touch with their corners run into each other as they grow: to first order in g.
    EXPECT_NEAR(here.edges, taken, 0.06 / sigma) << u << ' ' << v << ' ' << sigma;
    const auto edges = [&](double du, double dv) { return tag.sample(u + du, v + dv, blur).edges; };
    EXPECT_NEAR(here.edges_by_u, (edges(1e-3, 0) - edges(-1e-3, 0)) / 2e-3, 0.03 / (sigma * sigma));
    EXPECT_NEAR(here.edges_by_v, (edges(0, 1e-3) - edges(0, -1e-3)) / 2e-3, 0.03 / (sigma * sigma));
  }
}

TEST(BlurredTag, DerivativesEqualDifferences) {
  const BlurredTag tag(*tag_pattern("tag36h11", 7), 1);
  Random random(4);
  for (int i = 0; i < 60; ++i) {
    const double u = random.uniform(-1.1, 1.1);
    const double v = random.uniform(-1.1, 1.1);
    const TagBlur blur{0.004, random.uniform(-0.0006, 0.0006), 0.006};
    const TagSample here = tag.sample(u, v, blur);
    const auto change = [&](double du, double dv, const TagBlur& by, double step) {
      const auto value = [&](double s) {
        return tag
            .sample(u + s * du, v + s * dv,
                    {blur.uu + s * by.uu, blur.uv + s * by.uv, blur.vv + s * by.vv})
            .value;
      };
      return (value(step) - value(-step)) / (2 * step);
    };
    // The profile's table has cells of 1/64 σ, over which its slopes are means; errors are judged
    // against the largest values that each takes: 1/σ √(1/2π) and 1/σ² of these.
    EXPECT_NEAR(here.by_u, change(1, 0, {}, 1e-3), 0.01 * 6.3);
    EXPECT_NEAR(here.by_v, change(0, 1, {}, 1e-3), 0.01 * 5.2);
    EXPECT_NEAR(here.by_uu, change(0, 0, {1, 0, 0}, 1e-4), 0.04 * 60);
    EXPECT_NEAR(here.by_uv, change(0, 0, {0, 1, 0}, 1e-4), 0.04 * 60);
    EXPECT_NEAR(here.by_vv, change(0, 0, {0, 0, 1}, 1e-4), 0.04 * 60);
  }
}

}  // namespace
}  // namespace lvcalib
