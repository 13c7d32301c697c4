// SPDX-License-Identifier: GPL-3.0-or-later
#include "design/planning.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;

LidarDescription test_lidar() {
  LidarDescription lidar;
  lidar.sensors.azimuth_rad << -0.6, 0.6;
  lidar.sensors.elevation_rad << -0.6, 0.6;
  lidar.sensors.points_per_sr = 1.5e5;
  lidar.sensors.range_sigma_m = 0.008;
  lidar.sensors.edge_noise = 0.1;
  lidar.lines = {0};
  return lidar;
}

Result<ScenePlan> plan(const PlanOptions& options, const LidarDescription& lidar = test_lidar(),
                       const RunContext& context = {}) {
  return plan_scenes(Target{}, test::test_camera(), lidar, options, context);
}

double volume(const Matrix6d& covariance) {
  return covariance.determinant();
}

TEST(Planning, EverySceneMakesTheExtrinsicSurer) {
  PlanOptions options;
  options.scenes = 4;
  const auto out = plan(options);
  ASSERT_TRUE(out.ok()) << out.error().text();
  ASSERT_EQ(out->scenes.size(), 4U);
  for (std::size_t k = 1; k < 4; ++k) {
    EXPECT_LT(volume(out->scenes[k].covariance), volume(out->scenes[k - 1].covariance));
    for (std::size_t j = 0; j < k; ++j)
      EXPECT_NE(out->scenes[k].pose.text(), out->scenes[j].pose.text());
  }
  EXPECT_TRUE(out->scenes.back().determined);
}

// What four scenes tell is what two tell and the two that follow them.
TEST(Planning, GoesOnFromWhatIsKnown) {
  PlanOptions options;
  options.scenes = 4;
  const auto whole = plan(options);
  ASSERT_TRUE(whole.ok()) << whole.error().text();
  options.scenes = 2;
  options.known = whole->scenes[1].covariance;
  const auto rest = plan(options);
  ASSERT_TRUE(rest.ok()) << rest.error().text();
  ASSERT_EQ(rest->scenes.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(rest->scenes[k].pose.text(), whole->scenes[k + 2].pose.text());
    EXPECT_TRUE(rest->scenes[k].covariance.isApprox(whole->scenes[k + 2].covariance, 1e-4));
  }
  EXPECT_TRUE(rest->known.has_value());
  EXPECT_FALSE(whole->known.has_value());
  // One scene more of what is known well is better than four from nothing.
  options.scenes = 1;
  options.known = whole->scenes.back().covariance;
  const auto one = plan(options);
  ASSERT_TRUE(one.ok()) << one.error().text();
  EXPECT_TRUE(one->scenes.front().determined);
  EXPECT_LT(volume(one->scenes.front().covariance), volume(whole->scenes.back().covariance));
}

TEST(Planning, APoseThatIsTakenIsNotProposedAgain) {
  PlanOptions options;
  options.scenes = 1;
  const auto first = plan(options);
  ASSERT_TRUE(first.ok()) << first.error().text();
  // Held by hand: some centimetres and degrees beside it.
  Rigid3 held = first->scenes[0].pose.camera_from_board;
  held.translation += Eigen::Vector3d(0.03, -0.02, 0.05);
  held.rotation = held.rotation * Eigen::Quaterniond(Eigen::AngleAxisd(
                                      0.07, Eigen::Vector3d(1.0, 2.0, 1.0).normalized()));
  options.taken = {held};
  const auto second = plan(options);
  ASSERT_TRUE(second.ok()) << second.error().text();
  EXPECT_NE(second->scenes[0].pose.text(), first->scenes[0].pose.text());
  // A grid of which all is taken has nothing left.
  options.grid.distances_m = {2.0};
  options.grid.tilts_deg = {0.0};
  options.grid.rolls_deg = {0.0};
  options.grid.cells = 1;
  const auto nothing = plan(options);
  ASSERT_TRUE(nothing.ok());
  EXPECT_TRUE(nothing->scenes.empty());
}

TEST(Planning, WhatIsKnownMustBeACovariance) {
  PlanOptions options;
  options.known = Matrix6d::Zero();
  EXPECT_EQ(plan(options).error().kind, ErrorKind::kUsage);
  options.known = -Matrix6d::Identity();
  EXPECT_EQ(plan(options).error().kind, ErrorKind::kUsage);
}

TEST(Planning, BeatsScenesThatAreAllAlike) {
  PlanOptions options;
  options.scenes = 4;
  const auto planned = plan(options);
  PlanOptions alike = options;
  alike.grid.distances_m = {3.0, 3.01, 3.02, 3.03};
  alike.grid.tilts_deg = {0.0};
  alike.grid.rolls_deg = {0.0};
  alike.grid.cells = 1;
  const auto same = plan(alike);
  ASSERT_TRUE(planned.ok() && same.ok());
  EXPECT_LT(volume(planned->scenes.back().covariance),
            0.1 * volume(same->scenes.back().covariance));
}

TEST(Planning, WantedEffectsBecomeTestable) {
  PlanOptions options;
  options.scenes = 6;
  options.effects = {"range_walk", "board_bow"};
  const auto out = plan(options);
  ASSERT_TRUE(out.ok()) << out.error().text();
  for (const EffectVisibility& e : out->scenes.back().effects) EXPECT_GT(e.sigmas, 3.0) << e.id;
  EXPECT_TRUE(out->warnings.empty());
}

TEST(Planning, SaysWhatItCannotDo) {
  PlanOptions options;
  options.effects = {"range_wak"};
  EXPECT_THAT(plan(options).error().text(), HasSubstr("did you mean 'range_walk'?"));
  options.effects = {"scan_motion"};
  EXPECT_THAT(plan(options).error().text(), HasSubstr("no time"));
  options.effects = {"angle_zero"};
  EXPECT_THAT(plan(options).error().text(), HasSubstr("no data can tell"));
  // All but a turn of the LiDAR.
  options.effects = {"axis_wobble"};
  options.scenes = 1;
  const auto one = plan(options);
  ASSERT_TRUE(one.ok());
  ASSERT_FALSE(one->warnings.empty());
  EXPECT_THAT(one->warnings.back(), HasSubstr("axis_wobble stays hard to test"));
  options = {};
  options.scenes = 0;
  EXPECT_EQ(plan(options).error().kind, ErrorKind::kUsage);
  LidarDescription behind = test_lidar();
  behind.sensors.azimuth_rad << 2.0, 4.0;
  EXPECT_THAT(plan({}, behind).error().text(), HasSubstr("in view of both sensors"));
}

TEST(Planning, StopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const auto out = plan({}, test_lidar(), context);
  ASSERT_FALSE(out.ok());
  EXPECT_EQ(out.error().kind, ErrorKind::kCancelled);
}

}  // namespace
}  // namespace lvcalib
