// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/disturbances/motion.h"

#include <gtest/gtest.h>

#include "planted.h"

namespace lvcalib::simulation {
namespace {

TEST(MotionDisturbance, PointsComeFromWhereTheLidarThenIs) {
  const PlantedEffects planted = plant({{"scan_motion", 200}});
  const auto& noted = planted.details.at("scan_motion").at("velocity_mm_s");
  const Eigen::Vector3d velocity = 1e-3 * Eigen::Vector3d(noted[0], noted[1], noted[2]);
  EXPECT_NEAR(velocity.norm(), 0.2, 1e-9);
  const Surface surface = wall(3.0, 0.85, 0.5);
  const Cloud cloud = scan_wall(surface, planted, LidarKind::kAvia);
  ASSERT_EQ(cloud.time_s.size(), cloud.size());
  ASSERT_GT(cloud.time_s.back(), 0.1F);
  for (std::size_t i = 0; i < cloud.size(); i += 97) {
    const Eigen::Vector3d point =
        cloud.points_m[i].cast<double>() + static_cast<double>(cloud.time_s[i]) * velocity;
    EXPECT_NEAR(surface.normal().dot(point - surface.center_m), 0.0, 1e-5 * point.norm());
  }
}

TEST(MotionDisturbance, StandsStillUnlessPlanted) {
  EXPECT_FALSE(plant({}).motion.active());
  EXPECT_EQ(plant({{"scan_motion", 20}}).motion.position_m(0.0).norm(), 0.0);
}

}  // namespace
}  // namespace lvcalib::simulation
