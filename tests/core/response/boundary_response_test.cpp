// SPDX-License-Identifier: GPL-3.0-or-later
#include "response/boundary_response.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/statistics.h"
#include "core/response/response_scene.h"

namespace lvcalib {
namespace {

using simulation::LidarKind;
using simulation::SimulationOptions;
using ::testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

// What the simulator does to a beam whose axis meets an edge; no estimate enters. Axis jitter and
// footprint are independent Gaussians; half of the footprint is black, half white.
struct Truth {
  double pitch_rad, yaw_rad, range_m;
};
Truth truth_of(const simulation::LidarOptions& lidar) {
  const double jitter = lidar.angle_sigma_deg * kDegree;
  const double white = 0.85;
  const double edge = 0.5 * (0.07 + white);
  return {std::hypot(jitter, 1e-3 * lidar.beam_vertical_mrad),
          std::hypot(jitter, 1e-3 * lidar.beam_horizontal_mrad),
          lidar.range_sigma_m * std::pow(white / edge, lidar.range_dark_exponent)};
}

BoundaryResponse respond(const SimulationOptions& options, const ResponseOptions& how = {}) {
  const auto scenes = test::refined_scenes(options);
  auto response = calibrate_boundary_response(test::inputs_of(scenes), options.target, how, {});
  if (!response) {
    ADD_FAILURE() << response.error().text();
    return {};
  }
  return std::move(*response);
}

void expect_truth(const BoundaryResponse& response, const Truth& truth) {
  ASSERT_TRUE(response.all.has_value()) << response.reason.text();
  const ResponseStatistics& all = *response.all;
  const Eigen::Vector3d std_dev = all.std_dev();
  EXPECT_NEAR(std_dev(0), truth.pitch_rad, 0.05 * truth.pitch_rad);
  EXPECT_NEAR(std_dev(1), truth.yaw_rad, 0.05 * truth.yaw_rad);
  EXPECT_NEAR(std_dev(2), truth.range_m, 0.05 * truth.range_m);
  EXPECT_LT(std::abs(all.mean(0)), 0.01 * kDegree);
  EXPECT_LT(std::abs(all.mean(1)), 0.01 * kDegree);
  EXPECT_LT(std::abs(all.mean(2)), 0.001);
}

SimulationOptions paper_noise(std::uint64_t seed) {
  auto options = test::cloud_only_options(seed, LidarKind::kAvia);
  options.lidar.angle_sigma_deg = 0.15;
  options.lidar.beam_horizontal_mrad = options.lidar.beam_vertical_mrad = 0.0;
  options.lidar.range_sigma_m = 0.009;
  options.lidar.range_dark_exponent = 0.0;
  return options;
}

TEST(BoundaryResponse, RecoversThePapersNoise) {
  for (const std::uint64_t seed : {1, 2}) {
    SCOPED_TRACE(seed);
    auto options = paper_noise(seed);
    // As many overlap samples as the paper has: tens of thousands.
    options.lidar.points = 1'500'000;
    const BoundaryResponse response = respond(options);
    expect_truth(response, truth_of(options.lidar));
    // All of the scatter is jitter, and the slant of the boards shows it.
    EXPECT_GT(response.jitter_share_sigma, 0.0);
    EXPECT_NEAR(response.jitter_share, 1.0, 4.0 * response.jitter_share_sigma);
  }
}

TEST(BoundaryResponse, RecoversAnEllipticFootprint) {
  for (const LidarKind kind : {LidarKind::kRosette, LidarKind::kAvia}) {
    auto options = test::cloud_only_options(5, kind);
    options.lidar.range_follows_power = false;
    const BoundaryResponse response = respond(options);
    expect_truth(response, truth_of(options.lidar));
  }
}

TEST(BoundaryResponse, EverySceneAndClassHasItsOwnNumbers) {
  auto options = test::cloud_only_options(6, LidarKind::kAvia);
  const BoundaryResponse response = respond(options);
  ASSERT_TRUE(response.all.has_value()) << response.reason.text();
  ASSERT_EQ(response.scenes.size(), 3U);
  int n = 0;
  for (const SceneResponse& scene : response.scenes) {
    ASSERT_TRUE(scene.statistics.has_value()) << scene.reason.text();
    ASSERT_TRUE(scene.transition.has_value());
    EXPECT_EQ(scene.nodes.size(), 9U);
    n += scene.statistics->n;
    EXPECT_GT(scene.transition->mu_out, scene.transition->mu_in + 80.0);
    EXPECT_GT(scene.statistics->std_sigma.minCoeff(), 0.0);
  }
  EXPECT_EQ(response.all->n, n);
  for (const auto* cells : {&response.by_range, &response.by_incidence, &response.by_both}) {
    int in_cells = 0;
    for (const ResponseCell& cell : *cells) {
      in_cells += cell.n;
      EXPECT_LT(cell.range_low_m, cell.range_high_m);
      EXPECT_LT(cell.incidence_low_deg, cell.incidence_high_deg);
      EXPECT_EQ(cell.statistics.has_value(), cell.n >= 200) << cell.n;
    }
    EXPECT_EQ(in_cells, n);
  }
}

// δ and σ of the transition against the blur that the simulator applies: over scenes the errors
// must be what is stated. The edge of a disc blurred by σ lies σ²/2R inside the printed one.
TEST(BoundaryResponse, TransitionHoldsItsStatedErrors) {
  std::vector<double> delta;
  std::vector<double> sigma;
  for (std::uint64_t seed = 10; seed < 18; ++seed) {
    auto options = test::cloud_only_options(seed, LidarKind::kAvia);
    options.scenes = 1;
    options.lidar.beam_horizontal_mrad = options.lidar.beam_vertical_mrad = 1.0;
    options.lidar.range_follows_power = false;
    options.placement.max_tilt_deg = 1.0;  // The blur on the board is then the beam's own.
    const auto truth = test::simulated_scene(options);
    const BoundaryResponse response = respond(options);
    ASSERT_TRUE(response.scenes[0].transition.has_value()) << response.scenes[0].reason.text();
    const TransitionFit& fit = *response.scenes[0].transition;
    const Eigen::Vector2d c = options.target.outline().center_m();
    const double range = (truth.lidar_from_board * Eigen::Vector3d(c.x(), c.y(), 0.0)).norm();
    const double blur = range * truth_of(options.lidar).pitch_rad;
    sigma.push_back((fit.sigma_m - blur) / fit.sigma_sigma_m);
    delta.push_back((fit.delta_m + blur * blur / (2.0 * options.target.circle_radius_m)) /
                    fit.delta_sigma_m);
  }
  EXPECT_LT(rms(sigma), 1.9);
  EXPECT_LT(rms(delta), 1.9);
  EXPECT_GT(rms(sigma), 0.3);
  EXPECT_GT(rms(delta), 0.3);
}

TEST(BoundaryResponse, SaysWhyANodeGivesNothing) {
  auto options = test::cloud_only_options(7, LidarKind::kAvia);
  options.scenes = 1;
  auto scenes = test::refined_scenes(options);
  const auto states = [&] {
    auto response = calibrate_boundary_response(test::inputs_of(scenes), options.target, {}, {});
    EXPECT_TRUE(response.ok());
    return std::move(*response);
  };
  const Cloud good = scenes[0].cloud;
  const auto expect_all = [](const BoundaryResponse& response, NodeResponseState state) {
    EXPECT_FALSE(response.all.has_value());
    EXPECT_FALSE(response.reason.empty());
    ASSERT_EQ(response.scenes[0].nodes.size(), 9U);
    for (const NodeResponse& node : response.scenes[0].nodes) {
      EXPECT_EQ(node.state, state) << node.reason.text();
      EXPECT_THAT(node.reason, HasSubstr(describe(state)));
    }
  };
  for (float& v : scenes[0].cloud.intensity) v = std::min(v, 110.0F);
  expect_all(states(), NodeResponseState::kClipped);

  scenes[0].cloud = good;
  for (float& v : scenes[0].cloud.intensity) v = 80.0F;
  expect_all(states(), NodeResponseState::kNoContrast);

  Cloud thin;
  for (std::size_t i = 0; i < good.size(); i += 200) append_point(thin, good, i);
  scenes[0].cloud = thin;
  expect_all(states(), NodeResponseState::kTooFewSamples);

  scenes[0].cloud = good;
  scenes[0].refinement.nodes[4].valid = false;
  scenes[0].refinement.nodes[4].reason = Message("too few usable bins around the circle");
  const BoundaryResponse one_less = states();
  EXPECT_TRUE(one_less.all.has_value());
  EXPECT_EQ(one_less.scenes[0].nodes[4].state, NodeResponseState::kNotRefined);
  EXPECT_THAT(one_less.scenes[0].nodes[4].reason, HasSubstr("too few usable bins"));

  scenes[0].cloud.intensity.clear();
  EXPECT_THAT(states().reason, HasSubstr("no intensity"));
}

TEST(BoundaryResponse, WithoutCirclesOrScenesItSaysSo) {
  Target plain;
  plain.type = TargetType::kAprilGrid;
  const auto no_circles = calibrate_boundary_response({}, plain, {}, {});
  ASSERT_TRUE(no_circles.ok());
  EXPECT_THAT(no_circles->reason, HasSubstr("no circles"));
  const auto no_scenes = calibrate_boundary_response({}, Target{}, {}, {});
  ASSERT_TRUE(no_scenes.ok());
  EXPECT_THAT(no_scenes->reason, HasSubstr("not enough scenes"));
}

TEST(BoundaryResponse, StopsWhenAsked) {
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  auto options = test::cloud_only_options(8, LidarKind::kAvia);
  options.scenes = 1;
  const auto scenes = test::refined_scenes(options);
  const auto response =
      calibrate_boundary_response(test::inputs_of(scenes), options.target, {}, context);
  ASSERT_FALSE(response.ok());
  EXPECT_EQ(response.error().kind, ErrorKind::kCancelled);
}

}  // namespace
}  // namespace lvcalib
