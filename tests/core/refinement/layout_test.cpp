// SPDX-License-Identifier: GPL-3.0-or-later
#include "refinement/layout.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/statistics.h"
#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

struct Nodes {
  std::vector<Eigen::Vector2d> model;
  std::vector<Eigen::Vector2d> centers;
};

// The default target's nodes, moved by a known pose and scaled about the origin.
Nodes moved_nodes(const LayoutPose& pose, double scale) {
  Nodes nodes;
  for (const TargetNode& node : Target{}.nodes()) {
    nodes.model.push_back(node.center_m);
    nodes.centers.push_back(pose * (scale * node.center_m));
  }
  return nodes;
}

TEST(Layout, RecoversAnyTurnAndShift) {
  for (const double angle : {-3.1, -1.6, -0.3, 0.0, 0.7, 2.0, 3.1}) {
    const LayoutPose truth{angle, {0.3, -1.2}};
    const Nodes nodes = moved_nodes(truth, 1.0);
    const std::vector<double> weights(nodes.model.size(), 2.0);
    const LayoutPose pose = fit_layout(nodes.centers, nodes.model, weights);
    EXPECT_NEAR(std::remainder(pose.angle_rad - angle, 2.0 * M_PI), 0.0, 1e-12);
    EXPECT_LT((pose.translation_m - truth.translation_m).norm(), 1e-12);
  }
}

TEST(Layout, KeepsTheModelsSizeWhateverTheCentresSay) {
  const Nodes nodes = moved_nodes({0.4, {0.1, 0.2}}, 1.05);
  const std::vector<double> weights(nodes.model.size(), 1.0);
  const LayoutPose pose = fit_layout(nodes.centers, nodes.model, weights);
  const double span = (pose * nodes.model.front() - pose * nodes.model.back()).norm();
  EXPECT_NEAR(span, (nodes.model.front() - nodes.model.back()).norm(), 1e-12);
  EXPECT_NEAR(pose.angle_rad, 0.4, 1e-12);
}

TEST(Layout, WeightsDecideWhoIsBelieved) {
  const LayoutPose truth{0.4, {0.1, 0.2}};
  Nodes nodes = moved_nodes(truth, 1.0);
  std::vector<double> weights(nodes.model.size(), 1.0);
  nodes.centers[4] += Eigen::Vector2d(0.05, 0.05);
  EXPECT_GT(
      (fit_layout(nodes.centers, nodes.model, weights).translation_m - truth.translation_m).norm(),
      1e-3);
  weights[4] = 0.0;
  const LayoutPose pose = fit_layout(nodes.centers, nodes.model, weights);
  EXPECT_LT((pose.translation_m - truth.translation_m).norm(), 1e-12);
}

TEST(Layout, TwoPointsSuffice) {
  const LayoutPose truth{-1.0, {0.5, 0.5}};
  Nodes nodes = moved_nodes(truth, 1.0);
  nodes.model.resize(2);
  nodes.centers.resize(2);
  const LayoutPose pose = fit_layout(nodes.centers, nodes.model, {1.0, 3.0});
  EXPECT_NEAR(pose.angle_rad, -1.0, 1e-12);
}

TEST(LayoutScale, IsMeasuredWithItsTrueStandardDeviation) {
  constexpr double kSigma = 5e-4;
  Random random(1);
  std::vector<double> normalized;
  for (int draw = 0; draw < 1000; ++draw) {
    Nodes nodes = moved_nodes({0.3, {0.1, 0.2}}, 1.012);
    for (Eigen::Vector2d& center : nodes.centers) center += test::random_2d(random, kSigma);
    const std::vector<double> variances(nodes.model.size(), kSigma * kSigma);
    const LayoutScale scale = measure_scale(nodes.centers, nodes.model, variances);
    ASSERT_GT(scale.sigma, 0.0);
    normalized.push_back((scale.scale - 1.012) / scale.sigma);
  }
  EXPECT_NEAR(rms(normalized), 1.0, 0.08);
  EXPECT_NEAR(median(normalized), 0.0, 0.12);
}

TEST(LayoutScale, SaysNothingWithoutABaseLine) {
  const std::vector<Eigen::Vector2d> one{{0.1, 0.2}};
  EXPECT_EQ(measure_scale(one, one, {1e-6}).sigma, 0.0);
  EXPECT_EQ(measure_scale({}, {}, {}).scale, 1.0);
  // Two nodes at the same place.
  const std::vector<Eigen::Vector2d> same{{0.1, 0.2}, {0.1, 0.2}};
  EXPECT_EQ(measure_scale(same, same, {1e-6, 1e-6}).sigma, 0.0);
}

}  // namespace
}  // namespace lvcalib
