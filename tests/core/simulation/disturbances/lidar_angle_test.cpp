// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/disturbances/lidar_angle.h"

#include <numbers>

#include <gtest/gtest.h>

#include "base/statistics.h"
#include "planted.h"

namespace lvcalib::simulation {
namespace {

Shot shot_at(double azimuth, double elevation, std::uint16_t line = 0) {
  Shot shot;
  shot.direction = {std::cos(elevation) * std::cos(azimuth),
                    std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
  shot.line = line;
  return shot;
}

class Angles : public testing::Test {
 protected:
  // Reported − true azimuth and elevation, mrad.
  [[nodiscard]] Eigen::Vector2d error_mrad(const PlantedEffects& planted, const Shot& shot) const {
    const Eigen::Vector3d& reported = shot.direction;
    const Eigen::Vector3d truth = planted.angle.true_direction(pattern, shot);
    EXPECT_NEAR(truth.norm(), 1.0, 1e-12);
    return 1e3 * Eigen::Vector2d(
                     std::atan2(reported.y(), reported.x()) - std::atan2(truth.y(), truth.x()),
                     std::asin(reported.z()) - std::asin(truth.z()));
  }

  LidarOptions options = quiet(LidarKind::kSpinning);
  ScanPattern pattern{options, Random(1)};
};

TEST_F(Angles, ScaleGrowsWithTheAngles) {
  const PlantedEffects planted = plant({{"angle_scale", 2000}}, LidarKind::kSpinning);
  const double elevation_ppm = planted.details.at("angle_scale").at("elevation_ppm")[0];
  const Eigen::Vector2d error = error_mrad(planted, shot_at(0.3, -0.2));
  EXPECT_NEAR(error.x(), 0.6, 0.002);
  EXPECT_NEAR(error.y(), -0.2e-3 * elevation_ppm, 0.002);
  EXPECT_LE(std::abs(elevation_ppm), 2000.0);
}

TEST_F(Angles, EccentricityHasThePeriodOfATurn) {
  const PlantedEffects planted = plant({{"encoder_eccentricity", 2}}, LidarKind::kSpinning);
  const double phase = planted.details.at("encoder_eccentricity").at("phase_rad")[0];
  for (double azimuth = -1.5; azimuth < 1.5; azimuth += 0.3) {
    const Eigen::Vector2d error = error_mrad(planted, shot_at(azimuth, 0.1));
    EXPECT_NEAR(error.x(), 2.0 * std::sin(azimuth - phase), 0.01);
    EXPECT_NEAR(error.y(), 0.0, 1e-9);
  }
}

TEST_F(Angles, WobbleGrowsWithTheTangentOfTheElevation) {
  const PlantedEffects planted = plant({{"axis_wobble", 2}}, LidarKind::kSpinning);
  const double c = planted.details.at("axis_wobble").at("collimation_mrad")[0];
  for (const double elevation : {-0.35, 0.0, 0.35}) {
    const Eigen::Vector2d error = error_mrad(planted, shot_at(0.4, elevation));
    EXPECT_NEAR(error.x(), c / std::cos(elevation) + 2.0 * std::tan(elevation), 0.01);
    EXPECT_NEAR(error.y(), 0.0, 0.01);
  }
}

TEST_F(Angles, LinesHaveTheirNotedOffsets) {
  const PlantedEffects planted = plant({{"channel_angle_offset", 1}}, LidarKind::kSpinning);
  const auto& elevation = planted.details.at("channel_angle_offset").at("line_elevation_mrad");
  const auto& azimuth = planted.details.at("channel_angle_offset").at("line_azimuth_mrad");
  ASSERT_EQ(elevation.size(), 128U);
  EXPECT_NEAR(rms(elevation), 1.0, 1e-9);
  EXPECT_NEAR(rms(azimuth), 0.5, 1e-9);
  const Eigen::Vector2d error = error_mrad(planted, shot_at(0.2, 0.1, 5));
  EXPECT_NEAR(error.x(), azimuth[5], 1e-9);
  EXPECT_NEAR(error.y(), elevation[5], 1e-9);
}

TEST_F(Angles, LagReportsWhereTheScannerGoes) {
  // Turning clockwise at 20π rad/s: 5 µs later the azimuth is 0.3142 mrad smaller.
  const PlantedEffects planted = plant({{"encoder_lag", 5}}, LidarKind::kSpinning);
  EXPECT_NEAR(error_mrad(planted, shot_at(0.2, 0.1)).x(), -0.31416, 1e-4);
  // A rosette's own speed, from two positions half a microsecond either side.
  const LidarOptions rosette = quiet(LidarKind::kRosette);
  const ScanPattern flower(rosette, Random(2));
  const PlantedEffects lagging = plant({{"encoder_lag", 5}}, LidarKind::kRosette);
  for (std::size_t i = 100; i < 1000; i += 100) {
    const Shot shot = flower.shot(i);
    const Eigen::Vector3d speed = (flower.direction_at(shot, shot.time_s + 0.5e-6) -
                                   flower.direction_at(shot, shot.time_s - 0.5e-6)) *
                                  1e6;
    const Eigen::Vector3d error = shot.direction - lagging.angle.true_direction(flower, shot);
    EXPECT_LT((error - 5e-6 * speed).norm(), 0.01 * 5e-6 * speed.norm());
  }
}

TEST_F(Angles, ReportedPointsFollowTheTrueBeam) {
  // On a slanted wall the range is the one of the true direction.
  const Surface surface = wall(3.0, 0.85, 0.9);
  const PlantedEffects planted =
      plant({{"angle_scale", 3000}, {"encoder_eccentricity", 2}}, LidarKind::kAvia);
  const Cloud cloud = scan_wall(surface, planted, LidarKind::kAvia);
  const LidarOptions lidar = quiet(LidarKind::kAvia);
  const ScanPattern scanner(lidar, Random(7));
  for (std::size_t i = 0; i < cloud.size(); i += 97) {
    const Eigen::Vector3d truth = planted.angle.true_direction(scanner, scanner.shot(i));
    const Eigen::Vector3d point = cloud.points_m[i].cast<double>();
    EXPECT_NEAR(point.norm(), true_range_m(surface, truth), 1e-5 * point.norm());
    EXPECT_LT((point.normalized() - scanner.shot(i).direction).norm(), 1e-6);
  }
}

TEST_F(Angles, OriginOffsetTurnsPointsByOffsetOverRange) {
  const PlantedEffects planted = plant({{"beam_origin_offset", 10}});
  const Surface surface = wall(3.0, 0.85, 0.8);
  const Cloud cloud = scan_wall(surface, planted, LidarKind::kAvia);
  for (std::size_t i = 0; i < cloud.size(); i += 97) {
    const Eigen::Vector3d point = cloud.points_m[i].cast<double>();
    const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(point).normalized();
    const Eigen::Vector3d truth = point - 0.010 * left;
    EXPECT_NEAR(surface.normal().dot(truth - surface.center_m), 0.0, 1e-5 * point.norm());
    const double level = point.head<2>().norm();
    const double turned = std::atan2(point.y(), point.x()) - std::atan2(truth.y(), truth.x());
    EXPECT_NEAR(turned, 0.010 / level, 1e-5);
  }
}

}  // namespace
}  // namespace lvcalib::simulation
