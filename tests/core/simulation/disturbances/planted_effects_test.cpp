// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/disturbances/planted_effects.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "simulation/disturbances/registry.h"
#include "simulation/simulator.h"

namespace lvcalib::simulation {
namespace {

SimulationOptions small(LidarKind kind = LidarKind::kAvia) {
  SimulationOptions options;
  options.scenes = 1;
  options.lidar.kind = kind;
  options.lidar.points = 12'000;
  options.image.width_px = 480;
  options.image.height_px = 300;
  return options;
}

SimulatedScene simulated(const SimulationOptions& options, int scene = 0) {
  auto result = Simulator::create(options)->simulate_scene(scene, {});
  EXPECT_TRUE(result.ok());
  return std::move(*result);
}

bool same_cloud(const SimulatedScene& a, const SimulatedScene& b) {
  return a.cloud.points_m == b.cloud.points_m && a.cloud.intensity == b.cloud.intensity;
}

bool same_image(const SimulatedScene& a, const SimulatedScene& b) {
  return a.image.pixels == b.image.pixels;
}

// Which sensors an effect acts upon.
enum class Acts { kLidar, kCamera, kBoth };

Acts acts(const std::string& id) {
  const std::array both = {"board_bow", "print_scale", "ink_gain", "x_board_bump"};
  const std::array camera = {"intrinsics_error", "distortion_residual", "corner_bias",
                             "rolling_shutter", "x_lens_flaw"};
  if (std::find(both.begin(), both.end(), id) != both.end()) return Acts::kBoth;
  if (std::find(camera.begin(), camera.end(), id) != camera.end()) return Acts::kCamera;
  return Acts::kLidar;
}

TEST(PlantedEffects, EveryEffectShowsInItsSensorsAndOnlyThere) {
  const SimulatedScene without = simulated(small());
  for (const Disturbance& disturbance : disturbances()) {
    SimulationOptions options = small();
    // Nothing that noise could hide, and not the base simulation's own value.
    options.effects[disturbance.id] = disturbance.highest;
    const SimulatedScene with = simulated(options);
    const Acts where = acts(disturbance.id);
    EXPECT_EQ(same_cloud(without, with), where == Acts::kCamera) << disturbance.id;
    EXPECT_EQ(same_image(without, with), where == Acts::kLidar) << disturbance.id;
    EXPECT_EQ(without.lidar_from_board.matrix(), with.lidar_from_board.matrix()) << disturbance.id;
    EXPECT_EQ(without.camera_from_board.matrix(), with.camera_from_board.matrix())
        << disturbance.id;
  }
}

TEST(PlantedEffects, NeutralValuesLeaveEveryBit) {
  for (const LidarKind kind : {LidarKind::kAvia, LidarKind::kSpinning}) {
    SimulationOptions options = small(kind);
    const SimulatedScene without = simulated(options);
    for (const Disturbance& disturbance : disturbances()) {
      // Those that replace a setting of the simulation instead of adding to it.
      if (disturbance.id == "beam_divergence" || disturbance.id == "footprint_anisotropy" ||
          disturbance.id == "intensity_geometry") {
        continue;
      }
      const bool factor =
          disturbance.id == "boundary_range_pull" || disturbance.id == "intensity_nonlinearity";
      options.effects[disturbance.id] = factor ? 1.0 : 0.0;
    }
    const SimulatedScene with = simulated(options);
    EXPECT_TRUE(same_cloud(without, with));
    EXPECT_TRUE(same_image(without, with));
  }
}

TEST(PlantedEffects, FollowFromTheSeed) {
  SimulationOptions options = small();
  for (const Disturbance& disturbance : disturbances()) {
    options.effects[disturbance.id] = disturbance.typical;
  }
  const SimulatedScene once = simulated(options);
  const SimulatedScene again = simulated(options);
  EXPECT_TRUE(same_cloud(once, again));
  EXPECT_TRUE(same_image(once, again));
  const EffectDetails details = Simulator::create(options)->rig().effect_details;
  EXPECT_EQ(Simulator::create(options)->rig().effect_details, details);
  options.seed = 2;
  EXPECT_NE(Simulator::create(options)->rig().effect_details, details);
}

TEST(PlantedEffects, DetailsDoNotDependOnOtherEffects) {
  SimulationOptions options = small();
  options.effects["board_bow"] = 2.0;
  const EffectDetails alone = Simulator::create(options)->rig().effect_details;
  options.effects["range_cyclic"] = 3.0;
  options.effects["print_scale"] = 1000.0;
  const EffectDetails together = Simulator::create(options)->rig().effect_details;
  EXPECT_EQ(together.at("board_bow"), alone.at("board_bow"));
  EXPECT_EQ(together.size(), 3U);
}

TEST(PlantedEffects, ComposeInOneScan) {
  // The shift of every board point's range is the sum of those of the effects alone.
  const auto ranges = [](const std::map<std::string, double>& effects) {
    SimulationOptions options = small();
    options.effects = effects;
    const SimulatedScene scene = simulated(options);
    std::vector<double> out;
    for (const auto& point : scene.cloud.points_m) out.push_back(point.cast<double>().norm());
    return out;
  };
  const auto none = ranges({});
  const auto offset = ranges({{"range_offset", 20.0}});
  const auto walk = ranges({{"range_walk", 10.0}});
  const auto lines = ranges({{"channel_range_offset", 10.0}});
  const auto all =
      ranges({{"range_offset", 20.0}, {"range_walk", 10.0}, {"channel_range_offset", 10.0}});
  ASSERT_EQ(all.size(), none.size());
  for (std::size_t i = 0; i < none.size(); ++i) {
    const double sum = offset[i] + walk[i] + lines[i] - 2.0 * none[i];
    ASSERT_NEAR(all[i], sum, 2e-6 * all[i]);
  }
}

TEST(PlantedEffects, WarmUpRunsFromSceneToScene) {
  SimulationOptions options = small();
  options.scenes = 4;
  options.effects["range_warmup"] = 10.0;
  SimulationOptions cold = options;
  cold.effects.clear();
  double last = 1.0;
  for (int scene = 0; scene < 4; ++scene) {
    const SimulatedScene with = simulated(options, scene);
    const SimulatedScene without = simulated(cold, scene);
    const double error = with.cloud.points_m[0].cast<double>().norm() -
                         without.cloud.points_m[0].cast<double>().norm();
    const double clock = scene * RangeDisturbance::kSceneIntervalS;
    const double expected =
        0.010 * (0.7 * std::exp(-clock / 60.0) + 0.3 * std::exp(-clock / 240.0));
    EXPECT_NEAR(error, expected, 1e-5);
    EXPECT_LT(error, last);
    last = error;
  }
}

}  // namespace
}  // namespace lvcalib::simulation
