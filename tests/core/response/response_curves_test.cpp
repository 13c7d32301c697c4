// SPDX-License-Identifier: GPL-3.0-or-later
#include "response/response_curves.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace lvcalib {
namespace {

BoundarySample sample(float distance_m, float intensity, int node = 0) {
  BoundarySample s;
  s.distance_m = distance_m;
  s.intensity = intensity;
  s.node = node;
  return s;
}

SceneResponse scene_of(std::vector<BoundarySample> samples) {
  SceneResponse scene;
  scene.nodes.resize(2);
  scene.nodes[0].state = NodeResponseState::kUsed;
  scene.nodes[1].state = NodeResponseState::kNoContrast;
  scene.samples = std::move(samples);
  return scene;
}

TEST(ResponseCurves, MeansByDistanceWithTheirSigma) {
  const auto curve = transition_curve(
      scene_of({sample(0.0024F, 10.0F), sample(-0.0012F, 1000.0F), sample(0.0021F, 14.0F),
                sample(0.0027F, 99.0F, 1), sample(0.0029F, 12.0F)}));
  ASSERT_EQ(curve.size(), 2U);
  EXPECT_NEAR(curve[0].distance_m, -0.0015, 1e-12);
  EXPECT_EQ(curve[0].n, 1);
  EXPECT_TRUE(std::isnan(curve[0].mean_sigma));
  EXPECT_NEAR(curve[1].distance_m, 0.0025, 1e-12);
  EXPECT_EQ(curve[1].n, 3);  // The circle without contrast stays out.
  EXPECT_NEAR(curve[1].mean, 12.0, 1e-9);
  EXPECT_NEAR(curve[1].mean_sigma, 2.0 / std::sqrt(3.0), 1e-9);
}

TEST(ResponseCurves, RangesOfOverlapSamplesOfAllScenes) {
  auto near = sample(0.0F, 1.0F);
  near.overlap = true;
  near.range_residual_m = -0.0005F;
  auto far = near;
  far.range_residual_m = 0.0031F;
  auto outside = near;
  outside.overlap = false;
  const SceneResponse a = scene_of({near, far, outside});
  const SceneResponse b = scene_of({near, outside});
  const SceneResponse* const both[] = {&a, &b};
  const auto bins = range_histogram(both);
  ASSERT_EQ(bins.size(), 2U);
  EXPECT_NEAR(bins[0].low_m, -0.002, 1e-12);
  EXPECT_EQ(bins[0].n, 2);
  EXPECT_NEAR(bins[1].low_m, 0.002, 1e-12);
  EXPECT_EQ(bins[1].n, 1);
}

TEST(ResponseCurves, NothingGivesNothing) {
  EXPECT_TRUE(transition_curve(scene_of({})).empty());
  EXPECT_TRUE(range_histogram({}).empty());
}

}  // namespace
}  // namespace lvcalib
