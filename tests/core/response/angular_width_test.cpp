// SPDX-License-Identifier: GPL-3.0-or-later
#include "response/angular_width.h"

#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "base/random.h"
#include "base/statistics.h"

namespace lvcalib {
namespace {

constexpr double kEdgeShift = 0.0004;

Eigen::Matrix2d beam_covariance() {
  Eigen::Matrix2d a;
  a << 1.0e-6, 0.2e-6, 0.2e-6, 2.0e-6;
  return a;
}

// Edges all around at 3 m; levels jump with the jittering beam (share 1) or are soft (share 0).
std::vector<BoundarySample> ring(int count, double jitter_share, std::uint64_t seed) {
  Random random(seed);
  std::vector<BoundarySample> out;
  for (int i = 0; i < count; ++i) {
    const double psi = 2.0 * std::numbers::pi * random.uniform();
    const Eigen::Vector2d b = 3.0 * Eigen::Vector2d(std::sin(psi), std::cos(psi));
    const double sigma = std::sqrt(b.dot(beam_covariance() * b));
    const double d = random.uniform(-0.02, 0.02);
    const double beam = d - kEdgeShift + std::sqrt(jitter_share) * sigma * random.normal();
    const double soft = std::sqrt(1.0 - jitter_share) * sigma;
    const double level = soft > 0 ? normal_cdf(beam / soft) : (beam > 0 ? 1.0 : 0.0);
    BoundarySample s;
    s.across_m = b.cast<float>();
    s.distance_m = static_cast<float>(d);
    s.intensity = static_cast<float>(10.0 + 120.0 * level + 4.0 * random.normal());
    s.width_m = 0.006F;  // A first width half as large again as the true one.
    out.push_back(s);
  }
  return out;
}

std::vector<const BoundarySample*> pointers(const std::vector<BoundarySample>& samples) {
  std::vector<const BoundarySample*> out;
  for (const BoundarySample& s : samples) out.push_back(&s);
  return out;
}

TEST(AngularWidth, FindsTheEllipseOfJitteringAndOfWideBeams) {
  for (const double share : {0.0, 0.5, 1.0}) {
    const auto samples = ring(20'000, share, 1);
    const auto width = fit_angular_width(pointers(samples));
    ASSERT_TRUE(width.has_value()) << share;
    // Four stated errors; a variance errs twice as much as a width.
    EXPECT_LT((width->covariance_rad2 - beam_covariance()).norm(),
              8.0 * width->relative_sigma * beam_covariance().norm())
        << share;
    EXPECT_LT(width->relative_sigma, 0.02) << share;
    EXPECT_NEAR(width->delta_m, kEdgeShift, 2e-4) << share;
  }
}

TEST(AngularWidth, StatedErrorIsThatOfRepetition) {
  std::vector<double> errors;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto samples = ring(2'000, 0.5, seed);
    const auto width = fit_angular_width(pointers(samples));
    ASSERT_TRUE(width.has_value());
    const double ratio = std::sqrt(width->covariance_rad2.trace() / beam_covariance().trace());
    errors.push_back((ratio - 1.0) / width->relative_sigma);
  }
  EXPECT_NEAR(rms(errors), 1.0, 0.4);
}

TEST(AngularWidth, WithoutATransitionThereIsNone) {
  auto samples = ring(2'000, 0.0, 2);
  for (BoundarySample& s : samples) s.intensity = 50.0F;
  EXPECT_FALSE(fit_angular_width(pointers(samples)).has_value());
  EXPECT_FALSE(fit_angular_width({}).has_value());
}

}  // namespace
}  // namespace lvcalib
