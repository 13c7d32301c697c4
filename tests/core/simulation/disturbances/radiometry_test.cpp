// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/disturbances/radiometry.h"

#include <numbers>

#include <gtest/gtest.h>

#include "base/statistics.h"
#include "planted.h"

namespace lvcalib::simulation {
namespace {

// Mean intensity of the points near the x axis on a scale of 10 000 per unit of reflectivity.
double level(const Effects& effects, double range_m, double reflectivity, double turn_rad = 0.0,
             int line = -1) {
  const Room room{{wall(range_m, reflectivity, turn_rad)}, Eigen::Vector3d::UnitZ()};
  const RayCaster caster(room, Eigen::Vector3d::Zero());
  LidarOptions options = quiet(LidarKind::kAvia);
  options.intensity_scale = 1e4;
  const ScanPattern pattern(options, Random(7));
  const Cloud cloud = scan(options, pattern, caster, Random(8), {}, {plant(effects)});
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d point = cloud.points_m[i].cast<double>();
    if (point.normalized().x() < std::cos(0.05)) continue;
    if (line >= 0 && cloud.line[i] != line) continue;
    sum += cloud.intensity[i];
    ++count;
  }
  return 1e-4 * sum / count;
}

TEST(Radiometry, GeometryIsPowersOfCosineAndRange) {
  const Effects effects = {{"intensity_geometry", 0.6}};
  const double base = level(effects, 3.0, 0.5);
  EXPECT_NEAR(base, 0.5, 0.01);
  EXPECT_NEAR(level(effects, 3.0, 0.5, std::numbers::pi / 3) / base, std::pow(0.5, 0.6), 0.005);
  EXPECT_NEAR(level(effects, 6.0, 0.5) / base, std::pow(2.0, -0.3), 0.003);
}

TEST(Radiometry, GeometryGivesLinesTheirGain) {
  const Effects effects = {{"intensity_geometry", 0.0}};
  const auto percent = plant(effects).details.at("intensity_geometry").at("line_gain_percent");
  ASSERT_EQ(percent.size(), 6U);
  EXPECT_NEAR(rms(percent), 3.0, 1e-9);
  for (int line = 2; line < 4; ++line) {
    EXPECT_NEAR(level(effects, 3.0, 0.5, 0.0, line),
                0.5 * (1.0 + 0.01 * percent[static_cast<std::size_t>(line)]), 1e-3);
  }
}

TEST(Radiometry, NonlinearityIsAPowerThatKeepsWhite) {
  const double undisturbed = level({}, 3.0, 0.5);
  EXPECT_NEAR(level({{"intensity_nonlinearity", 0.7}}, 3.0, 0.5), std::pow(undisturbed, 0.7), 1e-3);
  const RadiometryDisturbance radiometry = plant({{"intensity_nonlinearity", 0.7}}).radiometry;
  EXPECT_NEAR(radiometry.intensity(150.0, 0.1, Eigen::Vector3d::UnitX(), 0, 150.0), 150.0, 1e-9);
  EXPECT_NEAR(radiometry.intensity(15.0, 0.1, Eigen::Vector3d::UnitX(), 0, 150.0),
              150.0 * std::pow(0.1, 0.7), 1e-9);
  EXPECT_EQ(radiometry.intensity(0.0, 0.1, Eigen::Vector3d::UnitX(), 0, 150.0), 0.0);
}

TEST(Radiometry, GlossAddsAtNormalIncidenceOnBoardsOnly) {
  const RadiometryDisturbance radiometry = plant({{"specular_lobe", 0.3}}).radiometry;
  EXPECT_NEAR(radiometry.gloss(1.0), 0.3, 1e-12);
  // At 10°: tan² = 0.031091, exp(−0.031091/0.0225) = 0.25113, cos⁻⁴ = 1.06315.
  EXPECT_NEAR(radiometry.gloss(std::cos(10.0 * std::numbers::pi / 180.0)), 0.3 * 0.25113 * 1.06315,
              1e-5);
  EXPECT_LT(radiometry.gloss(std::cos(0.6)), 1e-8);
  EXPECT_NEAR(level({{"specular_lobe", 0.3}}, 3.0, 0.5), level({}, 3.0, 0.5), 1e-9);

  const Target target;
  const PrintedBoard board(target);
  const Room room{{facing_board(3.0, board)}, Eigen::Vector3d::UnitZ()};
  const RayCaster caster(room, Eigen::Vector3d::Zero());
  const LidarOptions options = quiet(LidarKind::kAvia);
  const Eigen::Vector3d ahead = Eigen::Vector3d::UnitX();
  const Return dull = Beam(options, caster).fire(ahead, 0.0);
  const Return shiny = Beam(options, caster, {}, radiometry).fire(ahead, 0.0);
  EXPECT_NEAR(shiny.reflectivity - dull.reflectivity, 0.3, 1e-9);
  EXPECT_NEAR(shiny.intensity - dull.intensity, 0.3 * 150.0, 1e-6);
  EXPECT_NEAR(shiny.power - dull.power, 0.3 / 9.0, 1e-6);
}

TEST(Radiometry, SaturationClipsAndShifts) {
  const Effects effects = {{"receiver_saturation", 10}};
  // White at 3 m has 1/0.6 of the saturation power.
  EXPECT_NEAR(level(effects, 3.0, PrintedBoard::kWhite), 0.6 * level({}, 3.0, PrintedBoard::kWhite),
              2e-3);
  EXPECT_NEAR(level(effects, 3.0, 0.3), level({}, 3.0, 0.3), 1e-9);
  const auto shift = [&](double range_m, double reflectivity) {
    const Surface surface = wall(range_m, reflectivity);
    return 1e3 * mean_range_error_m(surface, scan_wall(surface, plant(effects), LidarKind::kAvia));
  };
  EXPECT_NEAR(shift(3.0, PrintedBoard::kWhite), 10.0, 0.05);
  EXPECT_NEAR(shift(3.0, PrintedBoard::kBlack), 0.0, 1e-3);
  // Twice as close, four times the power: 10 (1 + ln 4 / ln(1/0.6)) = 37.14 mm.
  EXPECT_NEAR(shift(1.5, PrintedBoard::kWhite), 37.14, 0.05);
}

TEST(Radiometry, ASmudgeOnTheWindowKeepsLightBackInItsPlace) {
  const PlantedEffects planted = plant({{"x_window_smudge", 0.3}});
  const auto& at = planted.details.at("x_window_smudge").at("center_rad");
  const auto kept = [&](double azimuth, double elevation) {
    const Eigen::Vector3d direction(std::cos(azimuth) * std::cos(elevation),
                                    std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
    return planted.radiometry.intensity(100.0, 1.0, direction, 0, 100.0);
  };
  EXPECT_TRUE(planted.radiometry.changes_intensity());
  EXPECT_NEAR(kept(at[0], at[1]), 70.0, 1e-9);
  EXPECT_NEAR(kept(at[0] + 0.1, at[1]), 100.0 - 30.0 * std::exp(-0.5), 0.1);
  EXPECT_NEAR(kept(at[0] + 1.0, at[1]), 100.0, 1e-6);
}

}  // namespace
}  // namespace lvcalib::simulation
