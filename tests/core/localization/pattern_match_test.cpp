// SPDX-License-Identifier: GPL-3.0-or-later
#include "localization/pattern_match.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "base/random.h"
#include "base/statistics.h"

namespace lvcalib {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// Random samples of the print on a plane, `scale` times its size, about the board and a little
// beyond it.
std::vector<PlanarSample> printed_samples(const Target& target, const PlanarPose& pose,
                                          double scale, double noise, int count, Random& random) {
  const BoardOutline outline = target.outline();
  const double half = 0.8 * outline.size_m().norm();
  std::vector<PlanarSample> samples;
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(-half, half);
    const double y = random.uniform(-half, half);
    const Eigen::Vector2d local = Eigen::Rotation2Dd(-pose.angle_rad) * Eigen::Vector2d(x, y);
    const auto albedo = target.albedo(outline.center_m() + local / scale);
    if (!albedo) continue;
    samples.push_back({(pose.center_m + Eigen::Vector2d(x, y)).cast<float>(),
                       static_cast<float>(10.0 + 115.0 * *albedo + noise * random.normal())});
  }
  return samples;
}

class PatternMatchTest : public ::testing::Test {
 protected:
  [[nodiscard]] PatternSearchRange everywhere() const {
    PatternSearchRange range;
    range.slack_m = 0.1;
    range.step_m = 0.027;
    range.separation_m = 0.11;
    for (int d = 0; d < 72; ++d) range.angles_rad.push_back(5.0 * d * kDegree);
    return range;
  }
  [[nodiscard]] std::vector<PatternMatch> search(const std::vector<PlanarSample>& samples) const {
    return search_pattern(samples, coarse_, center_, everywhere(), {});
  }
  Target target_;
  PatternTemplate coarse_{target_, 0.022};
  PatternTemplate fine_{target_, 0.011};
  Eigen::Vector2d center_ = target_.outline().center_m();
  Random random_{1};
};

TEST_F(PatternMatchTest, FindsAPosePlantedInNoise) {
  for (const double angle : {0.3, 1.9, -2.5}) {
    const PlanarPose truth{angle, {0.04, -0.06}};
    const auto samples = printed_samples(target_, truth, 1.0, 25.0, 6000, random_);
    const auto found = search(samples);
    ASSERT_FALSE(found.empty());
    EXPECT_LE(found.size(), 8U);
    for (std::size_t k = 1; k < found.size(); ++k) EXPECT_GE(found[k - 1].gain(), found[k].gain());
    // The best one lies at the right place; seen this coarsely, in any of the four assignments.
    EXPECT_LT((found[0].pose.center_m - truth.center_m).norm(), 0.04);
    EXPECT_LT(std::abs(std::remainder(found[0].pose.angle_rad - angle, std::numbers::pi / 2)),
              6.0 * kDegree);
    const double turn = std::remainder(found[0].pose.angle_rad - angle, std::numbers::pi / 2);
    PatternMatch match =
        refine_pattern_pose(samples, coarse_, center_, {angle + turn, found[0].pose.center_m});
    match = refine_pattern_pose(samples, fine_, center_, match.pose);
    EXPECT_LT((match.pose.center_m - truth.center_m).norm(), 0.002);
    EXPECT_LT(std::abs(std::remainder(match.pose.angle_rad - angle, 2 * std::numbers::pi)), 0.005);
    EXPECT_GT(match.correlation, 0.7);
    EXPECT_GT(match.gain(), found[1].gain());
    EXPECT_NEAR(match.scale, 1.0, 0.002 + 4.0 * match.scale_sigma);
  }
}

// So few that none is left out: those at the corners, which lie in all directions, count as well.
TEST_F(PatternMatchTest, EverySampleWithinTheOutlineCounts) {
  for (int k = 0; k < 16; ++k) {
    const PlanarPose truth{22.5 * k * kDegree, {0.013 * k - 0.1, 0.3 - 0.037 * k}};
    const auto samples = printed_samples(target_, truth, 1.0, 1.0, 3000, random_);
    PatternSearchRange range;
    range.center_m = truth.center_m;
    range.slack_m = 0.0;
    range.angles_rad = {truth.angle_rad};
    const auto found = search_pattern(samples, coarse_, center_, range, {});
    ASSERT_EQ(found.size(), 1U);
    int inside = 0;
    for (const PlanarSample& sample : samples) {
      const Eigen::Vector2d local =
          Eigen::Rotation2Dd(-truth.angle_rad) * (sample.uv_m.cast<double>() - truth.center_m);
      inside += coarse_.at(center_ + local).inside ? 1 : 0;
    }
    EXPECT_GT(inside, 400);
    // On the border itself rounding decides.
    EXPECT_NEAR(found[0].inside, inside, 2) << k;
  }
}

TEST_F(PatternMatchTest, MeasuresThePatternsSize) {
  for (const double scale : {0.985, 0.995, 1.01}) {
    const PlanarPose truth{0.4, {0.0, 0.01}};
    const auto samples = printed_samples(target_, truth, scale, 10.0, 20'000, random_);
    const PatternMatch match = refine_pattern_pose(samples, fine_, center_, {0.41, {0.003, 0.008}});
    ASSERT_GT(match.scale_sigma, 0.0);
    EXPECT_NEAR(match.scale, scale, 0.1 * std::abs(scale - 1.0) + 5.0 * match.scale_sigma);
  }
}

TEST_F(PatternMatchTest, ScaleHasItsTrueStandardDeviation) {
  // Drawn from the blurred pattern itself, so that the samples hold nothing but their noise.
  std::vector<double> normalized;
  const BoardOutline outline = target_.outline();
  for (int draw = 0; draw < 150; ++draw) {
    std::vector<PlanarSample> samples;
    while (samples.size() < 1500) {
      const double x = random_.uniform(outline.lower_left_m.x(), outline.upper_right_m.x());
      const double y = random_.uniform(outline.lower_left_m.y(), outline.upper_right_m.y());
      const auto s = fine_.at({x, y});
      if (!s.inside) continue;
      samples.push_back({(Eigen::Vector2d(x, y) - center_).cast<float>(),
                         static_cast<float>(100.0 * s.value + 10.0 * random_.normal())});
    }
    const PatternMatch match = refine_pattern_pose(samples, fine_, center_, {});
    normalized.push_back((match.scale - 1.0) / match.scale_sigma);
  }
  EXPECT_NEAR(rms(normalized), 1.0, 0.2);
}

TEST_F(PatternMatchTest, RandomIntensitiesDoNotPassForThePattern) {
  for (int draw = 0; draw < 10; ++draw) {
    auto samples = printed_samples(target_, {}, 1.0, 0.0, 6000, random_);
    for (PlanarSample& s : samples) s.intensity = static_cast<float>(random_.uniform(0.0, 130.0));
    double best = 0.0;
    for (const PatternMatch& start : search(samples)) {
      best = std::max(
          best, refine_pattern_pose(average_cells(samples, 0.011), coarse_, center_, start.pose)
                    .correlation);
    }
    EXPECT_LT(best, 0.6);
  }
}

TEST_F(PatternMatchTest, AStripedPanelDoesNotPassForThePattern) {
  for (const double width : {0.05, 0.1, 0.2}) {
    auto samples = printed_samples(target_, {}, 1.0, 0.0, 6000, random_);
    for (PlanarSample& s : samples) {
      const bool dark = std::fmod(s.uv_m.x() + 10.0F, 2.0F * static_cast<float>(width)) < width;
      s.intensity = (dark ? 10.0F : 125.0F) + static_cast<float>(4.0 * random_.normal());
    }
    double best = 0.0;
    for (const PatternMatch& start : search(samples)) {
      const auto match = refine_pattern_pose(samples, fine_, center_, start.pose);
      best = std::max(best, match.correlation);
    }
    EXPECT_LT(best, 0.6) << "stripes of " << width << " m";
  }
}

TEST_F(PatternMatchTest, ANegativePrintHasNoCorrelation) {
  auto samples = printed_samples(target_, {}, 1.0, 5.0, 6000, random_);
  for (PlanarSample& s : samples) s.intensity = 135.0F - s.intensity;
  const PatternMatch match = refine_pattern_pose(samples, fine_, center_, {});
  EXPECT_EQ(match.correlation, 0.0);
  EXPECT_EQ(match.gain(), 0.0);
}

TEST_F(PatternMatchTest, NothingToMatchIsNoMatch) {
  EXPECT_TRUE(search({}).empty());
  const PatternMatch none = refine_pattern_pose({}, fine_, center_, {});
  EXPECT_EQ(none.correlation, 0.0);
  EXPECT_EQ(none.inside, 0);
  // A plain surface has no contrast to follow.
  auto plain = printed_samples(target_, {}, 1.0, 0.0, 3000, random_);
  for (PlanarSample& s : plain) s.intensity = 80.0F;
  EXPECT_EQ(refine_pattern_pose(plain, fine_, center_, {}).correlation, 0.0);
  EXPECT_TRUE(search(plain).empty());
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const auto samples = printed_samples(target_, {}, 1.0, 5.0, 3000, random_);
  EXPECT_TRUE(search_pattern(samples, coarse_, center_, everywhere(), context).empty());
}

TEST_F(PatternMatchTest, GainGrowsWithCorrelationAndSamples) {
  PatternMatch match;
  match.correlation = 0.5;
  match.inside = 100;
  EXPECT_NEAR(match.gain(), -50.0 * std::log(0.75), 1e-9);
  EXPECT_NEAR(match.gain(4.0), -12.5 * std::log(0.75), 1e-9);
  match.correlation = 1.0;
  EXPECT_TRUE(std::isfinite(match.gain()));
  match.inside = 5;
  EXPECT_EQ(match.gain(), 0.0);
}

TEST(AverageCells, MeansOverSquares) {
  std::vector<PlanarSample> samples;
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    // A hundred samples crowd in one cell, the others spread; negative coordinates too.
    const double reach = i < 100 ? 0.01 : 1.0;
    const double u = random.uniform(-reach, i < 100 ? -1e-4 : reach);
    const double v = random.uniform(-reach, i < 100 ? -1e-4 : reach);
    samples.push_back({Eigen::Vector2d(u, v).cast<float>(), i < 100 ? 10.0F : 20.0F});
  }
  const auto cells = average_cells(samples, 0.1);
  EXPECT_LE(cells.size(), 400U);
  EXPECT_GT(cells.size(), 300U);
  const auto crowded = std::find_if(cells.begin(), cells.end(),
                                    [](const PlanarSample& s) { return s.intensity < 15.0F; });
  ASSERT_NE(crowded, cells.end());
  EXPECT_LT(crowded->uv_m.x(), 0.0F);
  EXPECT_GT(crowded->uv_m.x(), -0.1F);
  EXPECT_TRUE(average_cells({}, 0.1).empty());
}

}  // namespace
}  // namespace lvcalib
