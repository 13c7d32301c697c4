// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/room.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lvcalib::simulation {
namespace {

// A small panel at 2 m before a wall at 3 m, both facing the origin.
Room panel_and_wall() {
  Room room;
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  room.surfaces.push_back({{3, 0, 0}, y, z, 5.0, 5.0, {}, nullptr});
  room.surfaces.push_back({{2, 0.5, 0}, y, z, 0.2, 0.1, {}, nullptr});
  return room;
}

Hit shoot(const RayCaster& caster, const Eigen::Vector3d& direction) {
  RayCaster::Candidates storage;
  const Eigen::Vector3d unit = direction.normalized();
  return caster.cast(unit, caster.candidates(unit, 0.0, storage));
}

TEST(RayCaster, MeetsTheNearestSurfaceWhereItIs) {
  const Room room = panel_and_wall();
  const RayCaster caster(room, Eigen::Vector3d::Zero());
  const Hit panel = shoot(caster, {2, 0.6, 0.05});
  EXPECT_EQ(panel.surface, 1);
  EXPECT_NEAR(panel.u_m, 0.1, 1e-12);
  EXPECT_NEAR(panel.v_m, 0.05, 1e-12);
  EXPECT_NEAR(panel.range_m, Eigen::Vector3d(2, 0.6, 0.05).norm(), 1e-12);
  EXPECT_NEAR(panel.cos_incidence, 2.0 / panel.range_m, 1e-12);
  const Hit wall = shoot(caster, {3, 1.2, 0});
  EXPECT_EQ(wall.surface, 0);
  EXPECT_NEAR(wall.u_m, 1.2, 1e-12);
  EXPECT_EQ(shoot(caster, {-1, 0, 0}).surface, -1);
  const std::array<std::uint8_t, 2> all{0, 1};
  EXPECT_EQ(caster.cast(Eigen::Vector3d::Constant(NAN), all).surface, -1);
}

TEST(RayCaster, CandidatesNeverMissASurface) {
  const Room room = panel_and_wall();
  const RayCaster caster(room, {0.1, -0.2, 0.05});
  const std::array<std::uint8_t, 2> all{0, 1};
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector3d unit =
        Eigen::Vector3d(1.0, 0.001 * (i - 2000), 0.0003 * (i % 200)).normalized();
    ASSERT_EQ(shoot(caster, unit).surface, caster.cast(unit, all).surface) << i;
  }
}

}  // namespace
}  // namespace lvcalib::simulation
