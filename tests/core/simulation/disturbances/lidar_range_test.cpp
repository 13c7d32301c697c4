// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/disturbances/lidar_range.h"

#include <numbers>

#include <gtest/gtest.h>

#include "base/statistics.h"
#include "planted.h"

namespace lvcalib::simulation {
namespace {

double error_mm(const Effects& effects, double range_m, double reflectivity, double turn_rad = 0.0,
                double clock_s = 0.0) {
  const Surface surface = wall(range_m, reflectivity, turn_rad);
  const Cloud cloud = scan_wall(surface, plant(effects), LidarKind::kAvia, clock_s);
  return 1e3 * mean_range_error_m(surface, cloud);
}

TEST(RangeDisturbance, OffsetAddsToEveryRange) {
  EXPECT_NEAR(error_mm({{"range_offset", 20}}, 2.0, 0.85), 20.0, 1e-3);
  EXPECT_NEAR(error_mm({{"range_offset", -7}}, 5.0, 0.07), -7.0, 1e-3);
  EXPECT_NEAR(error_mm({}, 5.0, 0.07), 0.0, 1e-3);
}

TEST(RangeDisturbance, ScaleGrowsWithRange) {
  // 1000 ppm of 4 m; the cap's mean range is 0.06 % longer than its axis.
  EXPECT_NEAR(error_mm({{"range_scale", 1000}}, 4.0, 0.85), 4.0, 0.01);
  EXPECT_NEAR(error_mm({{"range_scale", -500}}, 2.0, 0.85), -1.0, 0.01);
}

TEST(RangeDisturbance, WeakEchoesCrossTheThresholdLate) {
  EXPECT_NEAR(error_mm({{"range_walk", 10}}, 3.0, PrintedBoard::kWhite), 0.0, 0.02);
  EXPECT_NEAR(error_mm({{"range_walk", 10}}, 3.0, PrintedBoard::kBlack), 10.0, 0.02);
  // White at 6 m has a quarter of the power. √(2 ln P/V) is 3.0255 for white at 3 m (P/V = 97.14),
  // 2.0393 for black (8), 2.5260 for white at 6 m (24.29): 10·(3.0255 − 2.5260)/0.9862 = 5.065 mm.
  EXPECT_NEAR(error_mm({{"range_walk", 10}}, 6.0, PrintedBoard::kWhite), 5.065, 0.03);
  // Closer than 3 m white comes too early.
  EXPECT_LT(error_mm({{"range_walk", 10}}, 1.5, PrintedBoard::kWhite), -2.0);
  // No echo is too weak to be ranged.
  EXPECT_TRUE(std::isfinite(error_mm({{"range_walk", 10}}, 100.0, 0.03)));
}

TEST(RangeDisturbance, IncidenceGrowsAsSecantLessOne) {
  EXPECT_NEAR(error_mm({{"range_incidence", 5}}, 3.0, 0.85, std::numbers::pi / 3), 5.0, 0.05);
  EXPECT_NEAR(error_mm({{"range_incidence", 5}}, 3.0, 0.85, 0.0), 0.0, 0.01);
}

TEST(RangeDisturbance, CyclicRepeatsAfterItsUnit) {
  const PlantedEffects planted = plant({{"range_cyclic", 3}});
  const double unit = planted.details.at("range_cyclic").at("unit_m")[0];
  EXPECT_GE(unit, 0.1);
  EXPECT_LE(unit, 0.4);
  std::vector<double> errors;
  for (int i = 0; i < 100; ++i) {
    RangeConditions shot;
    shot.range_m = 2.0 + 0.01 * i * unit;
    errors.push_back(1e3 * planted.range.error_m(shot));
    shot.range_m += unit;
    EXPECT_NEAR(1e3 * planted.range.error_m(shot), errors.back(), 1e-9);
  }
  double mean = 0.0;
  for (const double error : errors) mean += error / 100.0;
  EXPECT_NEAR(mean, 0.0, 1e-9);
  // Fundamental and second harmonic: 3/√2·√(1 + 0.15²).
  EXPECT_NEAR(rms(errors), 2.1451, 1e-3);
}

TEST(RangeDisturbance, NearErrorDecays) {
  // 30 exp(−3/1.5) = 4.060, 30 exp(−1.5/1.5) = 11.04.
  EXPECT_NEAR(error_mm({{"range_near", 30}}, 3.0, 0.85), 4.060, 0.01);
  EXPECT_NEAR(error_mm({{"range_near", 30}}, 1.5, 0.85), 11.036, 0.02);
}

TEST(RangeDisturbance, WarmupDecaysOverTheSceneClock) {
  // A scan of 0.125 s starts the clock.
  EXPECT_NEAR(error_mm({{"range_warmup", 10}}, 3.0, 0.85), 10.0, 0.02);
  // 10 (0.7 e⁻¹ + 0.3 e^−0.25) = 4.912.
  EXPECT_NEAR(error_mm({{"range_warmup", 10}}, 3.0, 0.85, 0.0, 60.0), 4.912, 0.02);
}

TEST(RangeDisturbance, DriftGrowsAnewInEveryScan) {
  const PlantedEffects planted = plant({{"range_drift", 20}});
  RangeConditions shot;
  shot.range_m = 3.0;
  shot.clock_s = 100.0;
  EXPECT_NEAR(planted.range.error_m(shot), 0.0, 1e-9);
  // 20 (1 − 0.7 e⁻¹ − 0.3 e^−0.25) = 10.177.
  shot.time_s = 0.2;
  EXPECT_NEAR(1e3 * planted.range.error_m(shot), 10.177, 1e-3);
  shot.time_s = 10.0;
  EXPECT_NEAR(1e3 * planted.range.error_m(shot), 20.0, 1e-3);
}

TEST(RangeDisturbance, LinesDifferByTheirNotedOffsets) {
  const PlantedEffects planted = plant({{"channel_range_offset", 10}});
  const auto& noted = planted.details.at("channel_range_offset").at("line_mm");
  ASSERT_EQ(noted.size(), 6U);
  EXPECT_NEAR(rms(noted), 10.0, 1e-9);
  const Surface surface = wall(3.0, 0.85);
  const Cloud cloud = scan_wall(surface, planted, LidarKind::kAvia);
  ASSERT_EQ(cloud.line.size(), cloud.size());
  for (std::size_t i = 0; i < cloud.size(); i += 17) {
    const Eigen::Vector3d point = cloud.points_m[i].cast<double>();
    EXPECT_NEAR(1e3 * (point.norm() - true_range_m(surface, point)), noted[cloud.line[i]], 0.01);
  }
}

TEST(RangeDisturbance, AzimuthRippleFollowsTheReportedAzimuth) {
  const PlantedEffects planted = plant({{"x_azimuth_ripple", 3}}, LidarKind::kSpinning);
  const auto& noted = planted.details.at("x_azimuth_ripple");
  const double periods = noted.at("periods_per_turn")[0];
  EXPECT_EQ(periods, std::round(periods));
  const Surface surface = wall(3.0, 0.85);
  const Cloud cloud = scan_wall(surface, planted, LidarKind::kSpinning);
  int checked = 0;
  for (std::size_t i = 0; i < cloud.size(); i += 101) {
    const Eigen::Vector3d point = cloud.points_m[i].cast<double>();
    if (point.x() < 0.5 * point.norm()) continue;
    const double azimuth = std::atan2(point.y(), point.x());
    const double expected = 3.0 * std::sin(periods * azimuth + noted.at("phase_rad")[0]);
    EXPECT_NEAR(1e3 * (point.norm() - true_range_m(surface, point)), expected, 0.01);
    ++checked;
  }
  EXPECT_GT(checked, 100);
}

TEST(RangeDisturbance, ErrorsAdd) {
  const double together = error_mm(
      {{"range_offset", 20}, {"range_scale", 1000}, {"range_walk", 10}, {"range_near", 30}}, 3.0,
      PrintedBoard::kBlack);
  EXPECT_NEAR(together, 20.0 + 3.0 + 10.0 + 4.06, 0.05);
}

}  // namespace
}  // namespace lvcalib::simulation
