// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/room_builder.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/board_placement.h"
#include "simulation/rig.h"

namespace lvcalib::simulation {
namespace {

class BuildRoom : public testing::Test {
 protected:
  Room build(std::uint64_t seed) {
    const ScanPattern pattern(options.lidar, Random(seed));
    lidar_from_board =
        *place_board(options, camera, camera_from_lidar, pattern, 1, Random(seed, 5));
    eye = camera_from_lidar.inverse().translation;
    return build_room(options, board, lidar_from_board, eye, Random(seed, 6));
  }
  static Hit shoot(const RayCaster& caster, const Eigen::Vector3d& direction) {
    RayCaster::Candidates storage;
    return caster.cast(direction, caster.candidates(direction, 0.0, storage));
  }

  SimulationOptions options;
  PrintedBoard board{options.target};
  Camera camera = random_camera(options.image, Random(1));
  Rigid3 camera_from_lidar = random_mount(Random(2));
  Rigid3 lidar_from_board;
  Eigen::Vector3d eye;
};

TEST_F(BuildRoom, IsClosedAndNeverHidesTheBoard) {
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    const Room room = build(seed);
    ASSERT_LE(room.surfaces.size(), RayCaster::kMaxSurfaces);
    for (const Eigen::Vector3d& origin : {Eigen::Vector3d(0, 0, 0), eye}) {
      const RayCaster caster(room, origin);
      Random random(seed, 9);
      for (int i = 0; i < 300; ++i) {
        const Eigen::Vector3d direction =
            Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
        ASSERT_GE(shoot(caster, direction).surface, 0) << seed;
      }
      for (const auto& point : outline_points(options.target, 11)) {
        const Eigen::Vector3d inner =
            0.998 * (point - Eigen::Vector3d(0.39, 0.39, 0)) + Eigen::Vector3d(0.39, 0.39, 0);
        const Hit hit = shoot(caster, (lidar_from_board * inner - origin).normalized());
        ASSERT_NE(room.surfaces[static_cast<std::size_t>(hit.surface)].board, nullptr) << seed;
      }
    }
  }
}

TEST_F(BuildRoom, ContentsFollowTheOptions) {
  const double half = 0.5 * board.outline().size_m().x();
  const auto panels = [&](const Room& room) {
    return std::count_if(room.surfaces.begin(), room.surfaces.end(),
                         [&](const Surface& s) { return s.half_u_m == half; });
  };
  EXPECT_EQ(panels(build(3)), 2);
  options.placement.decoy = false;
  EXPECT_EQ(panels(build(3)), 1);
  options.placement.clutter = false;
  EXPECT_EQ(build(3).surfaces.size(), 6U + 1U + 2U);  // room, board, two faces of the stand
  options.placement.board = false;
  EXPECT_EQ(build(3).surfaces.size(), 6U);
  options.placement.decoy = true;
  const Room decoy_only = build(3);
  EXPECT_EQ(panels(decoy_only), 1);
  EXPECT_EQ(decoy_only.surfaces.back().board, nullptr);
}

TEST_F(BuildRoom, BoardOnTheWallTouchesIt) {
  options.placement.flush_on_wall = true;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Room room = build(seed);
    // From the board's corners straight backwards there is a wall at once.
    for (const auto& point : outline_points(options.target, 2)) {
      const RayCaster caster(room, lidar_from_board * Eigen::Vector3d(point.x(), point.y(), -1e-4));
      const Hit hit = shoot(caster, lidar_from_board.rotation * -Eigen::Vector3d::UnitZ());
      ASSERT_GE(hit.surface, 0);
      EXPECT_LT(hit.range_m, 0.02);
    }
  }
}

}  // namespace
}  // namespace lvcalib::simulation
