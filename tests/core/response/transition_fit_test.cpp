// SPDX-License-Identifier: GPL-3.0-or-later
#include "response/transition_fit.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/statistics.h"

namespace lvcalib {
namespace {

constexpr double kDelta = 0.0006;
constexpr double kSigma = 0.003;

// Uniform distances; levels as the beam's place decides them: part of the blur is a soft
// footprint, the other part a jitter of the beam that scatters the levels within the transition.
std::vector<TransitionPoint> points(int count, double noise, std::uint64_t seed,
                                    double jitter_share = 0.5) {
  Random random(seed);
  std::vector<TransitionPoint> out;
  const double jitter = kSigma * std::sqrt(jitter_share);
  const double footprint = kSigma * std::sqrt(1.0 - jitter_share);
  for (int i = 0; i < count; ++i) {
    const double d = random.uniform(-0.03, 0.03);
    const double beam = d - kDelta + jitter * random.normal();
    const double level = footprint > 0 ? normal_cdf(beam / footprint) : (beam > 0 ? 1.0 : 0.0);
    out.push_back({d, 10.0 + 120.0 * level + noise * random.normal()});
  }
  return out;
}

TEST(TransitionFit, RecoversTheCurve) {
  const auto fit = fit_transition(points(20'000, 0.5, 1, 0.0), 0.006);
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(fit->mu_in, 10.0, 0.1);
  EXPECT_NEAR(fit->mu_out, 130.0, 0.1);
  EXPECT_NEAR(fit->delta_m, kDelta, 2e-5);
  EXPECT_NEAR(fit->sigma_m, kSigma, 0.01 * kSigma);
  EXPECT_NEAR(fit->noise, 0.5, 0.05);
}

// The stated errors are those of repetition, with a beam that jitters as with one that is wide.
TEST(TransitionFit, StatedErrorsHoldOverManyDraws) {
  for (const double share : {0.0, 0.5, 1.0}) {
    std::vector<double> delta;
    std::vector<double> sigma;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      const auto fit = fit_transition(points(1500, 5.0, seed, share), 0.005);
      ASSERT_TRUE(fit.has_value());
      delta.push_back((fit->delta_m - kDelta) / fit->delta_sigma_m);
      sigma.push_back((fit->sigma_m - kSigma) / fit->sigma_sigma_m);
    }
    // 60 draws: the root mean square of a standard normal is 1 ± 0.09.
    EXPECT_NEAR(rms(delta), 1.0, 0.35) << "jitter share " << share;
    EXPECT_NEAR(rms(sigma), 1.0, 0.35) << "jitter share " << share;
  }
}

TEST(TransitionFit, StraysDoNotPullIt) {
  auto data = points(5000, 4.0, 3);
  for (std::size_t k = 0; k < data.size(); k += 25) data[k].intensity = 400.0;
  const auto fit = fit_transition(data, 0.006);
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(fit->delta_m, kDelta, 4.0 * fit->delta_sigma_m);
  EXPECT_NEAR(fit->sigma_m, kSigma, 4.0 * fit->sigma_sigma_m);
}

TEST(TransitionFit, RefusesWhatIsNoTransition) {
  EXPECT_FALSE(fit_transition({}, 0.005).has_value());
  EXPECT_FALSE(fit_transition(points(15, 4.0, 4), 0.005).has_value());
  EXPECT_FALSE(fit_transition(points(500, 4.0, 4), 0.0).has_value());
  auto flat = points(500, 4.0, 5);
  Random random(6);
  for (TransitionPoint& p : flat) p.intensity = 50.0 + 4.0 * random.normal();
  EXPECT_FALSE(fit_transition(flat, 0.005).has_value());
  auto one_side = points(500, 4.0, 7);
  std::erase_if(one_side, [](const TransitionPoint& p) { return p.distance_m > -0.002; });
  EXPECT_FALSE(fit_transition(one_side, 0.005).has_value());
}

}  // namespace
}  // namespace lvcalib
