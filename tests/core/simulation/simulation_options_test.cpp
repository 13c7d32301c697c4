// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/simulation_options.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "simulation/disturbances/registry.h"

namespace lvcalib::simulation {
namespace {

ErrorKind refusal(const std::function<void(SimulationOptions&)>& spoil) {
  SimulationOptions options;
  spoil(options);
  const Status status = check(options);
  EXPECT_FALSE(status.ok());
  return status.ok() ? ErrorKind::kOutput : status.error().kind;
}

TEST(SimulationOptions, DefaultsAreFine) {
  EXPECT_TRUE(check(SimulationOptions{}).ok());
}

TEST(SimulationOptions, RefusesValuesOutOfRange) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  using O = SimulationOptions;
  const std::vector<std::function<void(O&)>> spoilers = {
      [](O& o) { o.scenes = 0; },
      [](O& o) { o.scenes = -1; },
      [](O& o) { o.scenes = 1001; },
      [](O& o) { o.lidar.points = -1; },
      [](O& o) { o.lidar.points = 20'000'000; },
      [](O& o) { o.lidar.range_sigma_m = -0.001; },
      [](O& o) { o.lidar.range_sigma_m = kNan; },
      [](O& o) { o.lidar.beam_rays = 0; },
      [](O& o) { o.lidar.beam_rays = 257; },
      [](O& o) {
        o.lidar.kind = LidarKind::kSpinning;
        o.lidar.lines = 48;
      },
      [](O& o) { o.image.width_px = -1440; },
      [](O& o) { o.image.full_well_e = 0.0; },
      [](O& o) { o.placement.min_distance_m = 5.0; },
      [](O& o) { o.placement.max_distance_m = std::numeric_limits<double>::infinity(); },
      [](O& o) {
        o.placement.board = false;
        o.placement.partial = true;
      },
  };
  for (const auto& spoil : spoilers) EXPECT_EQ(refusal(spoil), ErrorKind::kUsage);
}

TEST(SimulationOptions, RefusesImpossibleTargets) {
  EXPECT_EQ(refusal([](auto& o) { o.target.tag_family = "tag99h9"; }), ErrorKind::kInput);
  EXPECT_EQ(refusal([](auto& o) { o.target.tag_columns = -4; }), ErrorKind::kInput);
}

TEST(SimulationOptions, RefusesUnknownEffectsByName) {
  SimulationOptions options;
  options.effects["warp_drive"] = 1.0;
  const Status status = check(options);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::kUsage);
  EXPECT_NE(status.error().message.text().find("warp_drive"), std::string::npos);
  EXPECT_NE(status.error().message.text().find("known effects"), std::string::npos);
}

TEST(SimulationOptions, RefusesEffectsOutOfRangeOrWithoutLines) {
  EXPECT_EQ(refusal([](auto& o) { o.effects["range_walk"] = 1000.0; }), ErrorKind::kUsage);
  EXPECT_EQ(refusal([](auto& o) {
              o.lidar.kind = LidarKind::kRosette;
              o.effects["channel_range_offset"] = 10.0;
            }),
            ErrorKind::kUsage);
  SimulationOptions board;
  board.target.type = TargetType::kCheckerboard;
  board.target.corner_columns = 6;
  board.target.corner_rows = 5;
  board.target.column_spacing_m = board.target.row_spacing_m = 0.1;
  board.target.board_width_m = board.target.board_height_m = 0.8;
  EXPECT_TRUE(check(board).ok());
  board.effects["corner_bias"] = 0.2;
  EXPECT_FALSE(check(board).ok());
  SimulationOptions options;
  for (const Disturbance& planted : disturbances()) options.effects[planted.id] = 0.3;
  EXPECT_TRUE(check(options).ok());
}

TEST(SimulationOptions, LineCountFollowsTheKind) {
  LidarOptions lidar;
  EXPECT_EQ(line_count(lidar), 6);
  lidar.kind = LidarKind::kSpinning;
  lidar.lines = 64;
  EXPECT_EQ(line_count(lidar), 64);
  lidar.kind = LidarKind::kRosette;
  EXPECT_EQ(line_count(lidar), 1);
}

TEST(SimulationOptions, PointCountFollowsTheKind) {
  LidarOptions lidar;
  EXPECT_EQ(point_count(lidar), 240'000);
  lidar.kind = LidarKind::kSpinning;
  lidar.lines = 64;
  EXPECT_EQ(point_count(lidar), 5 * 1800 * 64);
  lidar.points = 7;
  EXPECT_EQ(point_count(lidar), 7);
}

}  // namespace
}  // namespace lvcalib::simulation
