// SPDX-License-Identifier: GPL-3.0-or-later
#include "refinement/transition.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/statistics.h"

namespace lvcalib {
namespace {

constexpr double kIn = 0.04;
constexpr double kOut = 0.025;

// Samples across an edge blurred by `footprint`, whose middle lies at `crossing` (m).
std::vector<UnwrappedSample> edge_samples(int count, const Eigen::Matrix2d& footprint,
                                          double crossing, double noise, double from_rad,
                                          double to_rad, Random& random) {
  std::vector<UnwrappedSample> samples;
  for (int i = 0; i < count; ++i) {
    const double psi = random.uniform(from_rad, to_rad);
    UnwrappedSample s;
    s.cos_psi = std::cos(psi);
    s.sin_psi = std::sin(psi);
    s.distance_m = random.uniform(-kIn, kOut);
    const Eigen::Vector2d e(s.cos_psi, s.sin_psi);
    s.level = normal_cdf((s.distance_m - crossing) / std::sqrt(e.dot(footprint * e))) +
              noise * random.normal();
    samples.push_back(s);
  }
  return samples;
}

Eigen::Matrix2d round_footprint(double sigma_m) {
  return sigma_m * sigma_m * Eigen::Matrix2d::Identity();
}

TEST(TransitionModel, RecoversAnEllipticFootprint) {
  Eigen::Matrix2d truth;
  truth << 16e-6, 4e-6, 4e-6, 9e-6;
  Random random(1);
  const auto samples =
      edge_samples(20'000, truth, 0.0, 0.05, -std::numbers::pi, std::numbers::pi, random);
  for (const double start : {0.002, 0.007}) {
    TransitionModel model(start);
    for (int round = 0; round < 4; ++round) model.update(samples, 4e-4, 0.04);
    EXPECT_LT((model.footprint_m2() - truth).norm(), 0.05 * truth.norm()) << model.footprint_m2();
    EXPECT_NEAR(model.mean_sigma_m(), std::sqrt(0.5 * truth.trace()), 1e-4);
    UnwrappedSample along_x;
    EXPECT_NEAR(model.sigma_m(along_x), 0.004, 2e-4);
  }
}

TEST(TransitionModel, RecoversTheNoise) {
  Random random(2);
  const auto samples = edge_samples(20'000, round_footprint(0.004), 0.0, 0.08, -std::numbers::pi,
                                    std::numbers::pi, random);
  TransitionModel model(0.004);
  model.update(samples, 4e-4, 0.04);
  for (const double z : {-4.0, -1.2, 0.1, 1.3, 4.0}) {
    EXPECT_NEAR(std::sqrt(model.noise().variance(z)), 0.08, 0.008) << "z = " << z;
  }
}

TEST(TransitionModel, NoiseInTheTransitionIsToldFromNoiseOnThePlateaus) {
  Random random(3);
  auto samples = edge_samples(30'000, round_footprint(0.004), 0.0, 0.03, -std::numbers::pi,
                              std::numbers::pi, random);
  for (UnwrappedSample& s : samples) {
    if (std::abs(s.distance_m) < 0.004) s.level += 0.15 * random.normal();
  }
  TransitionModel model(0.004);
  model.update(samples, 4e-4, 0.04);
  EXPECT_GT(model.noise().variance(0.2), 9.0 * model.noise().variance(4.0));
}

TEST(TransitionModel, StaysWithinItsLimitsWhateverTheData) {
  Random random(4);
  TransitionModel model(0.004);
  // Pure noise, and nothing at all.
  std::vector<UnwrappedSample> noise = edge_samples(2'000, round_footprint(0.004), 0.0, 2.0,
                                                    -std::numbers::pi, std::numbers::pi, random);
  for (UnwrappedSample& s : noise) s.level = random.uniform(-5.0, 5.0);
  model.update(noise, 4e-4, 0.04);
  model.update({}, 4e-4, 0.04);
  EXPECT_TRUE(model.footprint_m2().allFinite());
  EXPECT_GE(model.mean_sigma_m(), 4e-4 * 0.999);
  EXPECT_LE(model.mean_sigma_m(), 0.04 * 1.001);
  EXPECT_GT(model.noise().variance(0.0), 0.0);
}

TEST(Crossing, IsUnbiasedAndItsStandardDeviationTrue) {
  const Eigen::Matrix2d footprint = round_footprint(0.004);
  Random random(5);
  TransitionModel model(0.004);
  for (int k = 0; k < 3; ++k) {
    model.update(
        edge_samples(20'000, footprint, 0.0, 0.06, -std::numbers::pi, std::numbers::pi, random),
        4e-4, 0.04);
  }
  for (const double truth : {-0.003, 0.0, 0.004}) {
    std::vector<double> error;
    std::vector<double> normalized;
    for (int draw = 0; draw < 1000; ++draw) {
      BinRecord bin;
      solve_crossing(edge_samples(60, footprint, truth, 0.06, 0.1, 0.5, random), model, kIn, kOut,
                     4, bin);
      if (bin.state != BinState::kUsed) continue;
      error.push_back(bin.midpoint_m - truth);
      normalized.push_back(error.back() / bin.sigma_m);
      EXPECT_GT(bin.angle_rad, 0.1);
      EXPECT_LT(bin.angle_rad, 0.5);
    }
    ASSERT_GT(error.size(), 950U);
    double mean = 0.0;
    for (const double e : error) mean += e / static_cast<double>(error.size());
    // Four standard errors.
    EXPECT_NEAR(mean, 0.0, 4.0 * rms(error) / std::sqrt(1000.0));
    EXPECT_NEAR(rms(normalized), 1.0, 0.12) << "crossing " << truth;
  }
}

class BadBins : public ::testing::Test {
 protected:
  BinState state(const std::vector<UnwrappedSample>& samples, int min_samples = 4) const {
    BinRecord bin;
    solve_crossing(samples, model_, kIn, kOut, min_samples, bin);
    EXPECT_EQ(bin.samples, static_cast<int>(samples.size()));
    return bin.state;
  }
  [[nodiscard]] std::vector<UnwrappedSample> good() {
    return edge_samples(60, round_footprint(0.004), 0.0, 0.03, 0.1, 0.5, random_);
  }
  TransitionModel model_{0.004};
  Random random_{6};
};

TEST_F(BadBins, GoodOnesAreUsed) {
  EXPECT_EQ(state(good()), BinState::kUsed);
}

TEST_F(BadBins, TooFewSamplesAreRefused) {
  auto samples = good();
  samples.resize(5);
  EXPECT_EQ(state(samples, 6), BinState::kTooFewSamples);
  EXPECT_EQ(state({}), BinState::kTooFewSamples);
}

TEST_F(BadBins, SamplesOnOneSideAreRefused) {
  auto samples = good();
  std::erase_if(samples, [](const UnwrappedSample& s) { return s.distance_m > -0.003; });
  // The inner flank of the transition alone still has a slope.
  ASSERT_GE(samples.size(), 10U);
  EXPECT_EQ(state(samples), BinState::kOneSided);
}

TEST_F(BadBins, AllBlackOrAllWhiteHasNoCrossing) {
  for (const double level : {0.0, 1.0}) {
    auto samples = good();
    for (UnwrappedSample& s : samples) s.level = level;
    EXPECT_EQ(state(samples), BinState::kNoCrossing) << "level " << level;
  }
}

// A bin worked by hand. Slots of the profile are 6.5 mm wide, from 40 mm inside to 25 mm outside.
class Midpoint : public ::testing::Test {
 protected:
  struct At {
    double distance_mm;
    double level;
  };
  static std::vector<UnwrappedSample> samples(const std::vector<At>& list) {
    std::vector<UnwrappedSample> out;
    for (const At& at : list) {
      UnwrappedSample s;
      s.distance_m = 1e-3 * at.distance_mm;
      s.level = at.level;
      out.push_back(s);
    }
    return out;
  }
  static BinRecord solve(const std::vector<UnwrappedSample>& samples, int min_samples = 4,
                         double min_contrast = 3.0) {
    BinRecord bin;
    interpolate_midpoint(samples, {kIn, kOut, 0.0135, 0.0125}, min_samples, min_contrast, bin);
    return bin;
  }
  const std::vector<At> black_ = {{-36, 0.1}, {-30, 0.1}, {-24, 0.12}, {-17, 0.08}};
  const std::vector<At> white_ = {{15, 0.9}, {17, 0.88}, {22, 0.92}};
  // One stray in the slot that ends at −1 mm; its median is none.
  const std::vector<At> edge_ = {{-5, 0.2}, {-4, 0.3}, {-3, 0.9}, {1, 0.6}, {2, 0.7}, {3, 0.65}};
  std::vector<At> all() const {
    std::vector<At> out = black_;
    out.insert(out.end(), edge_.begin(), edge_.end());
    out.insert(out.end(), white_.begin(), white_.end());
    return out;
  }
};

TEST_F(Midpoint, IsInterpolatedBetweenMedians) {
  const BinRecord bin = solve(samples(all()));
  ASSERT_EQ(bin.state, BinState::kUsed);
  // Levels 0.1 and 0.9, so the mid-level is 0.5, between (−4 mm, 0.3) and (2 mm, 0.65).
  EXPECT_NEAR(bin.midpoint_m, -0.004 + 0.006 * (0.5 - 0.3) / (0.65 - 0.3), 1e-12);
  // Weight: contrast times support.
  EXPECT_NEAR(1.0 / (bin.sigma_m * bin.sigma_m), 0.8 * 13, 1e-9);
  EXPECT_EQ(bin.samples, 13);
}

TEST_F(Midpoint, OfSeveralRisesTheNearestToTheCircleCounts) {
  auto list = all();
  // A white fleck well inside: the profile rises there too.
  list.push_back({-25, 0.8});
  list.push_back({-25.5, 0.8});
  list.push_back({-25.2, 0.8});
  const BinRecord bin = solve(samples(list), 4, 0.0);
  ASSERT_EQ(bin.state, BinState::kUsed);
  EXPECT_GT(bin.midpoint_m, -0.004);
  EXPECT_LT(bin.midpoint_m, 0.002);
}

TEST_F(Midpoint, BinsThatSayTooLittleAreRefused) {
  EXPECT_EQ(solve(samples(all()), 14).state, BinState::kTooFewSamples);
  EXPECT_EQ(solve(samples(black_)).state, BinState::kOneSided);
  // Of a contrast of 0.8 and a deviation of 0.03 by the medians.
  EXPECT_EQ(solve(samples(all()), 4, 20.0).state, BinState::kUsed);
  EXPECT_EQ(solve(samples(all()), 4, 40.0).state, BinState::kWeakContrast);
  auto same = samples(all());
  for (UnwrappedSample& s : same) s.level = 0.5;
  EXPECT_EQ(solve(same).state, BinState::kWeakContrast);
}

}  // namespace
}  // namespace lvcalib
