// SPDX-License-Identifier: GPL-3.0-or-later
#include "response/response_statistics.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.h"

namespace lvcalib {
namespace {

// Edges all around, at 3 m, frontal: an angle of 1 rad moves the hit by 3 m. The region reaches
// √6 widths, as wide as `angular` blurs in the edge's direction.
std::vector<BoundarySample> ring(int count, const Eigen::Matrix2d& angular, double slant_m,
                                 double jitter_share, std::uint64_t seed) {
  Random random(seed);
  std::vector<BoundarySample> out;
  const Eigen::Matrix2d root = angular.llt().matrixL();
  for (int i = 0; i < count; ++i) {
    const double psi = 2.0 * std::numbers::pi * random.uniform();
    const Eigen::Vector2d b = 3.0 * Eigen::Vector2d(std::sin(psi), std::cos(psi));
    BoundarySample s;
    s.across_m = b.cast<float>();
    s.slant_m = Eigen::Vector2f(0.0F, static_cast<float>(slant_m));
    s.width_m = static_cast<float>(std::sqrt(b.dot(angular * b)));
    s.distance_m = static_cast<float>(random.uniform(-1.0, 1.0) * std::sqrt(6.0)) * s.width_m;
    const double u = random.normal();
    const double v = random.normal();
    const Eigen::Vector2d alpha = root * Eigen::Vector2d(u, v);
    s.range_residual_m =
        static_cast<float>(0.01 * random.normal() + std::sqrt(jitter_share) * slant_m * alpha.y());
    s.residual = Eigen::Vector3f(s.distance_m * static_cast<float>(b.x() / b.squaredNorm()),
                                 s.distance_m * static_cast<float>(b.y() / b.squaredNorm()),
                                 s.range_residual_m);
    s.overlap = true;
    out.push_back(s);
  }
  return out;
}

OverlapSet set_of(const std::vector<BoundarySample>& samples) {
  OverlapSet set;
  for (const BoundarySample& s : samples) {
    set.samples.push_back(&s);
    set.half_width_m.push_back(std::sqrt(6.0) * static_cast<double>(s.width_m));
    set.shift_m.push_back(0.0);
  }
  set.relative_width_sigma = 0.01;
  return set;
}

Eigen::Matrix2d ellipse() {
  Eigen::Matrix2d a;
  a << 1.0e-6, 0.3e-6, 0.3e-6, 2.2e-6;
  return a;
}

TEST(ResponseStatistics, FindsTheAngularEllipse) {
  const auto samples = ring(20'000, ellipse(), 0.0, 0.0, 1);
  const auto stats = summarize_response(set_of(samples), {}, 200);
  ASSERT_TRUE(stats.has_value());
  EXPECT_LT((stats->covariance.topLeftCorner<2, 2>() - ellipse()).norm(), 0.03 * ellipse().norm());
  EXPECT_NEAR(std::sqrt(stats->covariance(2, 2)), 0.01, 0.0003);
  EXPECT_EQ(stats->n, 20'000);
  EXPECT_LT(std::abs(stats->mean(0)), 4.0 * stats->mean_sigma(0));
  // The widths' own error of 1 % is the floor.
  EXPECT_GT(stats->std_sigma(0), 0.01 * stats->std_dev()(0));
  EXPECT_LT(stats->std_sigma(0), 0.02 * stats->std_dev()(0));
}

TEST(ResponseStatistics, ForARoundBeamThePlainCovarianceIsTheSame) {
  const Eigen::Matrix2d round = 1.5e-6 * Eigen::Matrix2d::Identity();
  const auto samples = ring(20'000, round, 0.0, 0.0, 2);
  const auto stats = summarize_response(set_of(samples), {}, 200);
  ASSERT_TRUE(stats.has_value());
  EXPECT_LT((stats->paired.topLeftCorner<2, 2>() - round).norm(), 0.04 * round.norm());
  EXPECT_LT((stats->covariance.topLeftCorner<2, 2>() - round).norm(), 0.04 * round.norm());
}

TEST(ResponseStatistics, JitterOnSlantedBoardsIsToldFromRangeNoise) {
  for (const double share : {0.0, 1.0}) {
    auto samples = ring(8'000, ellipse(), 0.0, share, 3);
    const auto slanted = ring(8'000, ellipse(), 6.0, share, 4);
    samples.insert(samples.end(), slanted.begin(), slanted.end());
    const OverlapSet set = set_of(samples);
    const JitterShare jitter = measure_jitter_share(set.samples, angular_covariance(set));
    ASSERT_GT(jitter.sigma, 0.0);
    EXPECT_NEAR(jitter.share, share, 4.0 * jitter.sigma);
    const auto stats = summarize_response(set, jitter, 200);
    ASSERT_TRUE(stats.has_value());
    EXPECT_NEAR(std::sqrt(stats->covariance(2, 2)), 0.01, 0.0005) << share;
  }
}

TEST(ResponseStatistics, BoardsAllAlikeCannotTellJitter) {
  const auto samples = ring(5'000, ellipse(), 0.0, 1.0, 5);
  const OverlapSet set = set_of(samples);
  EXPECT_EQ(measure_jitter_share(set.samples, angular_covariance(set)).sigma, 0.0);
}

TEST(ResponseStatistics, TooFewOrOneSidedSamplesGiveNothing) {
  const auto few = ring(150, ellipse(), 0.0, 0.0, 6);
  EXPECT_FALSE(summarize_response(set_of(few), {}, 200).has_value());
  auto samples = ring(2'000, ellipse(), 0.0, 0.0, 7);
  std::erase_if(samples, [](const BoundarySample& s) { return std::abs(s.across_m.x()) > 0.6F; });
  ASSERT_GT(samples.size(), 200U);
  EXPECT_FALSE(summarize_response(set_of(samples), {}, 200).has_value());
}

}  // namespace
}  // namespace lvcalib
