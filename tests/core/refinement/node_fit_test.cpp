// SPDX-License-Identifier: GPL-3.0-or-later
#include "refinement/node_fit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <Eigen/Cholesky>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "base/statistics.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;

constexpr double kBlack = 12.0;
constexpr double kWhite = 125.0;
constexpr double kBlur = 0.004;

// A printed circle as a LiDAR sees it: radius as the target's, the centre at `center`.
struct Circle {
  Eigen::Vector2d center = {0.002, -0.0015};
  double radius_change_m = 0.0;
  double noise = 4.0;
  int samples = 2500;
  /// Changes the place of the edge (m) at an angle; none by default.
  std::function<double(double)> edge_shift = [](double) { return 0.0; };

  [[nodiscard]] std::vector<PlaneSample> draw(const NodeWindow& window, Random& random) const {
    const double reach = window.radius_m + window.outside_m + 0.005;
    std::vector<PlaneSample> out;
    while (static_cast<int>(out.size()) < samples) {
      const Eigen::Vector2d p(random.uniform(-reach, reach), random.uniform(-reach, reach));
      const Eigen::Vector2d d = p - center;
      const double edge = window.radius_m + radius_change_m + edge_shift(std::atan2(d.y(), d.x()));
      const double level = normal_cdf((d.norm() - edge) / kBlur);
      out.push_back({p, kBlack + (kWhite - kBlack) * level + noise * random.normal()});
    }
    return out;
  }
};

class NodeFitTest : public ::testing::Test {
 protected:
  NodeFit fit(const std::vector<PlaneSample>& samples,
              const Eigen::Vector2d& center = Circle{}.center, double radius_change_m = 0.0) {
    NodeRecord record;
    auto unwrapped = unwrap_node(samples, Eigen::Vector2d::Zero(), window_, kBlur, record);
    TransitionModel model(kBlur);
    // The noise as the refinement knows it after its first round.
    std::vector<UnwrappedSample> centred = unwrapped;
    for (UnwrappedSample& s : centred)
      s.distance_m -= center.x() * s.cos_psi + center.y() * s.sin_psi + radius_change_m;
    model.update(centred, kBlur, kBlur);
    return fit_node(unwrapped, record, window_, model, options_);
  }
  static int count(const NodeFit& fit, BinState state) {
    return static_cast<int>(std::count_if(fit.record.bins.begin(), fit.record.bins.end(),
                                          [&](const BinRecord& b) { return b.state == state; }));
  }
  Target target_;
  NodeWindow window_ = node_window(target_);
  RefinementOptions options_;
  Random random_{1};
};

TEST_F(NodeFitTest, WindowEndsBeforeTheTags) {
  EXPECT_EQ(window_.radius_m, target_.circle_radius_m);
  EXPECT_LT(window_.inside_m, window_.radius_m);
  EXPECT_GT(window_.outside_m, 0.0);
  // All of the window is circle and paper: no tag reaches into it.
  const Eigen::Vector2d node = target_.nodes()[4].center_m;
  for (int k = 0; k < 360; ++k) {
    const double a = k * std::numbers::pi / 180.0;
    const double r = window_.radius_m + window_.outside_m - 1e-4;
    EXPECT_EQ(target_.albedo(node + r * Eigen::Vector2d(std::cos(a), std::sin(a))), 1.0);
  }
}

TEST_F(NodeFitTest, LevelsAndDistancesAreMeasured) {
  Circle circle;
  circle.center.setZero();
  NodeRecord record;
  const auto unwrapped =
      unwrap_node(circle.draw(window_, random_), Eigen::Vector2d::Zero(), window_, kBlur, record);
  EXPECT_NEAR(record.inner_level, kBlack, 1.0);
  EXPECT_NEAR(record.outer_level, kWhite, 1.0);
  ASSERT_GT(unwrapped.size(), 1000U);
  for (const UnwrappedSample& s : unwrapped) {
    EXPECT_GE(s.distance_m, -window_.inside_m);
    EXPECT_LE(s.distance_m, window_.outside_m + 1e-12);
    EXPECT_NEAR(std::hypot(s.cos_psi, s.sin_psi), 1.0, 1e-12);
    if (s.distance_m < -4 * kBlur) {
      EXPECT_NEAR(s.level, 0.0, 0.25);
    }
    if (s.distance_m > 4 * kBlur) {
      EXPECT_NEAR(s.level, 1.0, 0.25);
    }
  }
}

TEST_F(NodeFitTest, WaveIsTheCentresShiftAndTheRadiusChangeWithTrueCovariance) {
  // The wave is of first order: the refinement repeats it until the shift is small, as here.
  Circle circle;
  circle.center = {0.0003, -0.0002};
  circle.radius_change_m = 0.0005;
  const Eigen::Vector3d truth(0.0003, -0.0002, 0.0005);
  std::vector<double> normalized;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  constexpr int kDraws = 150;
  for (int draw = 0; draw < kDraws; ++draw) {
    const NodeFit result =
        fit(circle.draw(window_, random_), circle.center, circle.radius_change_m);
    ASSERT_TRUE(result.record.valid) << result.record.reason.text();
    const Eigen::Vector3d error = result.record.wave_m - truth;
    mean += error / kDraws;
    const Eigen::Vector3d white = result.covariance_m2.llt().matrixL().solve(error);
    for (const double w : white) normalized.push_back(w);
  }
  EXPECT_NEAR(rms(normalized), 1.0, 0.15);
  EXPECT_LT(mean.norm(), 2e-5) << mean.transpose();
}

TEST_F(NodeFitTest, MoreSamplesMoreBinsWithinTheLimits) {
  Circle circle;
  circle.samples = 200;
  const auto sparse = fit(circle.draw(window_, random_)).record.bins.size();
  EXPECT_EQ(sparse, static_cast<std::size_t>(options_.min_bins));
  circle.samples = 5000;
  EXPECT_EQ(fit(circle.draw(window_, random_)).record.bins.size(),
            static_cast<std::size_t>(options_.max_bins));
}

TEST_F(NodeFitTest, AnEmptySectorGivesBinsWithTooFewSamples) {
  auto samples = Circle{}.draw(window_, random_);
  std::erase_if(samples, [](const PlaneSample& s) {
    return std::abs(std::atan2(s.uv_m.y(), s.uv_m.x())) < 0.6;
  });
  const NodeFit result = fit(samples);
  EXPECT_TRUE(result.record.valid);
  EXPECT_GE(count(result, BinState::kTooFewSamples), 3);
  EXPECT_LT((result.record.wave_m.head<2>() - Eigen::Vector2d(0.002, -0.0015)).norm(), 0.001);
}

TEST_F(NodeFitTest, ASectorSeenOnlyInsideIsOneSidedOrWithoutCrossing) {
  auto samples = Circle{}.draw(window_, random_);
  std::erase_if(samples, [&](const PlaneSample& s) {
    return std::abs(std::atan2(s.uv_m.y(), s.uv_m.x())) < 0.6 &&
           s.uv_m.norm() > window_.radius_m - 0.002;
  });
  const NodeFit result = fit(samples);
  EXPECT_TRUE(result.record.valid);
  EXPECT_GE(count(result, BinState::kOneSided), 1);
  EXPECT_LT((result.record.wave_m.head<2>() - Eigen::Vector2d(0.002, -0.0015)).norm(), 0.001);
}

TEST_F(NodeFitTest, ACoveredSectorHasNoCrossing) {
  auto samples = Circle{}.draw(window_, random_);
  for (PlaneSample& s : samples) {
    // Black tape from the middle outwards.
    if (std::abs(std::atan2(s.uv_m.y(), s.uv_m.x())) < 0.6) s.intensity = kBlack;
  }
  const NodeFit result = fit(samples);
  EXPECT_TRUE(result.record.valid);
  EXPECT_GE(count(result, BinState::kNoCrossing), 2);
  EXPECT_LT((result.record.wave_m.head<2>() - Eigen::Vector2d(0.002, -0.0015)).norm(), 0.001);
}

TEST_F(NodeFitTest, ABinThatContradictsTheOthersIsAnOutlier) {
  Circle circle;
  circle.edge_shift = [](double psi) { return std::abs(psi - 1.0) < 0.13 ? 0.008 : 0.0; };
  const NodeFit result = fit(circle.draw(window_, random_));
  EXPECT_TRUE(result.record.valid);
  EXPECT_GE(count(result, BinState::kOutlier), 1);
  EXPECT_LE(count(result, BinState::kOutlier), 3);
  for (const BinRecord& bin : result.record.bins) {
    if (bin.state == BinState::kOutlier) {
      EXPECT_NEAR(bin.angle_rad, 1.0, 0.4);
    }
  }
  EXPECT_LT((result.record.wave_m.head<2>() - Eigen::Vector2d(0.002, -0.0015)).norm(), 6e-4);
}

TEST_F(NodeFitTest, NoiseNearTheLevelDifferenceIsWeakContrast) {
  Circle circle;
  circle.noise = 0.6 * (kWhite - kBlack);
  const NodeFit result = fit(circle.draw(window_, random_));
  EXPECT_FALSE(result.record.valid);
  EXPECT_EQ(count(result, BinState::kUsed), 0);
  EXPECT_GE(count(result, BinState::kWeakContrast), 4);
  EXPECT_FALSE(result.record.reason.empty());
  // The threshold is the user's.
  options_.min_contrast = 0.0;
  EXPECT_EQ(count(fit(circle.draw(window_, random_)), BinState::kWeakContrast), 0);
}

TEST_F(NodeFitTest, PlainPaperOrAWhiteDiscIsNoCircle) {
  auto samples = Circle{}.draw(window_, random_);
  for (PlaneSample& s : samples) s.intensity = kWhite + 4.0 * random_.normal();
  NodeRecord record;
  EXPECT_TRUE(unwrap_node(samples, Eigen::Vector2d::Zero(), window_, kBlur, record).empty());
  EXPECT_THAT(record.reason, HasSubstr("no contrast"));
  samples = Circle{}.draw(window_, random_);
  for (PlaneSample& s : samples) s.intensity = kWhite + kBlack - s.intensity;
  record = {};
  EXPECT_TRUE(unwrap_node(samples, Eigen::Vector2d::Zero(), window_, kBlur, record).empty());
  EXPECT_THAT(record.reason, HasSubstr("no contrast"));
}

TEST_F(NodeFitTest, TooFewSamplesSayHowManyThereAre) {
  auto samples = Circle{}.draw(window_, random_);
  samples.resize(9);
  NodeRecord record;
  EXPECT_TRUE(unwrap_node(samples, Eigen::Vector2d::Zero(), window_, kBlur, record).empty());
  EXPECT_THAT(record.reason, HasSubstr("too few samples"));
  EXPECT_THAT(record.reason, HasSubstr("inside"));
  EXPECT_TRUE(unwrap_node({}, Eigen::Vector2d::Zero(), window_, kBlur, record).empty());
}

TEST_F(NodeFitTest, AnArcIsNotEnoughForAWave) {
  auto samples = Circle{}.draw(window_, random_);
  // A sixth of the circle: too little to tell shift from radius.
  std::erase_if(samples, [&](const PlaneSample& s) {
    return s.uv_m.norm() > 0.5 * window_.radius_m &&
           std::abs(std::atan2(s.uv_m.y(), s.uv_m.x())) > 0.3;
  });
  const NodeFit result = fit(samples);
  EXPECT_FALSE(result.record.valid);
  EXPECT_FALSE(result.record.reason.empty());
}

TEST_F(NodeFitTest, MidpointsGiveTheWaveToo) {
  options_.estimator = CenterEstimator::kMidpoint;
  Circle circle;
  circle.center = {0.0005, -0.0003};
  circle.samples = 5000;
  const NodeFit result = fit(circle.draw(window_, random_), circle.center);
  ASSERT_TRUE(result.record.valid) << result.record.reason.text();
  EXPECT_LT((result.record.wave_m.head<2>() - circle.center).norm(), 6e-4);
  // The unit of the weights is the one in which the midpoints scatter as they say.
  EXPECT_NEAR(result.chi_square, result.degrees_of_freedom, 1e-6);
  double weight = 0.0;
  for (const BinRecord& bin : result.record.bins) {
    if (bin.state == BinState::kUsed) weight += bin.samples;
  }
  // Contrast, over that of the whole node, is about one.
  EXPECT_NEAR(result.weight, weight, 0.1 * weight);
}

// What ours leaves out as a contradiction, the paper keeps, and its centre is off by it.
TEST_F(NodeFitTest, MidpointsKeepABinThatContradictsTheOthers) {
  Circle circle;
  circle.samples = 5000;
  circle.edge_shift = [](double psi) { return std::abs(psi - 1.0) < 0.2 ? 0.012 : 0.0; };
  const auto samples = circle.draw(window_, random_);
  const NodeFit ours = fit(samples);
  options_.estimator = CenterEstimator::kMidpoint;
  const NodeFit paper = fit(samples);
  ASSERT_TRUE(ours.record.valid && paper.record.valid);
  EXPECT_GE(count(ours, BinState::kOutlier), 1);
  EXPECT_EQ(count(paper, BinState::kOutlier), 0);
  const auto error = [&](const NodeFit& f) {
    return (f.record.wave_m.head<2>() - circle.center).norm();
  };
  EXPECT_GT(error(paper), 2.0 * error(ours));
}

}  // namespace
}  // namespace lvcalib
