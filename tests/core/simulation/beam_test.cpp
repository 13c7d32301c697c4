// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/beam.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/statistics.h"

namespace lvcalib::simulation {
namespace {

const Eigen::Vector3d kY = Eigen::Vector3d::UnitY();
const Eigen::Vector3d kZ = Eigen::Vector3d::UnitZ();

// The board upright at x = range, facing the LiDAR; its point `center` on the x axis.
Surface board_at(double range_m, const PrintedBoard& board, const Eigen::Vector2d& center) {
  const Eigen::Vector2d offset = board.outline().center_m() - center;
  Surface surface;
  surface.center_m = {range_m, -offset.x(), offset.y()};
  surface.u = -kY;
  surface.v = kZ;
  surface.half_u_m = 0.5 * board.outline().size_m().x();
  surface.half_v_m = 0.5 * board.outline().size_m().y();
  surface.board = &board;
  return surface;
}

Texture plain(double reflectivity) {
  return {Texture::Kind::kPlain, reflectivity, 0.0, 1.0, 0};
}

Surface panel(double range_m, double half_m, double reflectivity, double y_m = 0.0) {
  return {{range_m, y_m, 0.0}, kY, kZ, half_m, half_m, plain(reflectivity), nullptr};
}

// Direction that meets x = range at (y, z).
Eigen::Vector3d towards(double range_m, double y_m, double z_m) {
  return Eigen::Vector3d(range_m, y_m, z_m).normalized();
}

struct Transition {
  double at(double offset_m, bool vertical) const {
    const Beam beam(options, caster);
    double sum = 0.0;
    constexpr int kTurns = 64;
    for (int i = 0; i < kTurns; ++i) {
      const double along = circle_radius_m + offset_m;
      const auto direction = vertical ? towards(range_m, 0, along) : towards(range_m, along, 0);
      sum += beam.fire(direction, 2.0 * std::numbers::pi * i / kTurns).reflectivity;
    }
    return (sum / kTurns - PrintedBoard::kBlack) / (PrintedBoard::kWhite - PrintedBoard::kBlack);
  }
  // Slope at the edge of a Gaussian transition: 1/(√(2π) σ).
  [[nodiscard]] double sigma_m(bool vertical) const {
    const double h = 1e-4 * range_m;
    return 2.0 * h / (at(h, vertical) - at(-h, vertical)) / std::sqrt(2.0 * std::numbers::pi);
  }

  explicit Transition(double range, const LidarOptions& lidar) : options(lidar), range_m(range) {}
  LidarOptions options;
  double range_m;
  Target target;
  double circle_radius_m = target.circle_radius_m;
  PrintedBoard board{target};
  Room room{{board_at(range_m, board, target.nodes()[4].center_m)}, kZ};
  RayCaster caster{room, Eigen::Vector3d::Zero()};
};

TEST(Beam, TransitionGrowsWithRangeAsTheFootprintSays) {
  LidarOptions options;
  options.beam_horizontal_mrad = 1.2;
  options.beam_vertical_mrad = 0.6;
  for (const double range : {2.0, 4.0}) {
    const Transition transition(range, options);
    EXPECT_NEAR(transition.sigma_m(false), 1.2e-3 * range, 0.04e-3 * range) << range;
    EXPECT_NEAR(transition.sigma_m(true), 0.6e-3 * range, 0.02e-3 * range) << range;
    EXPECT_NEAR(transition.at(-0.015, false), 0.0, 0.002);
    EXPECT_NEAR(transition.at(0.015, false), 1.0, 0.002);
    // Inside a black disc the white surrounds the footprint: slightly above one half.
    EXPECT_NEAR(transition.at(0.0, false), 0.5 + 0.5 * 0.8 * 0.6e-3 * range / 0.045, 0.02);
  }
}

TEST(Beam, PlainSurfaceGivesItsRangeAndReflectivity) {
  LidarOptions options;
  const Room room{{panel(3.0, 5.0, 0.5)}, kZ};
  const RayCaster caster(room, Eigen::Vector3d::Zero());
  const Return hit = Beam(options, caster).fire(towards(3.0, 1.0, 0.5), 0.3);
  EXPECT_NEAR(hit.range_m, Eigen::Vector3d(3, 1, 0.5).norm(), 1e-12);
  EXPECT_NEAR(hit.reflectivity, 0.5, 1e-12);
  const double left = std::pow(3.0 / hit.range_m, options.incidence_exponent) *
                      std::pow(hit.range_m / 3.0, -options.range_exponent);
  EXPECT_NEAR(hit.intensity, 150.0 * 0.5 * left, 1e-9);
}

TEST(Beam, DepthEdgesMixWithinThePulseAndSplitBeyondIt) {
  LidarOptions options;
  for (const double behind : {0.1, 1.0}) {
    const Room room{{panel(3.0 + behind, 5.0, 0.5), panel(3.0, 1.0, 0.5, 1.0)}, kZ};
    const RayCaster caster(room, Eigen::Vector3d::Zero());
    const Beam beam(options, caster);
    int between = 0;
    for (int i = -40; i <= 40; ++i) {
      const Return hit = beam.fire(towards(3.0, 1e-4 * i, 0.0), 0.1 * i);
      ASSERT_GE(hit.range_m, 3.0 - 1e-6);
      ASSERT_LE(hit.range_m, 3.0 + behind + 1e-4);
      if (hit.range_m > 3.01 && hit.range_m < 3.0 + behind - 0.01) ++between;
      // A part of the light that is lost behind the edge lowers the intensity.
      ASSERT_LT(hit.reflectivity, 0.5 + 1e-9);
    }
    if (behind < 0.5) {
      EXPECT_GT(between, 20);
    } else {
      EXPECT_EQ(between, 0);
    }
  }
}

TEST(Beam, RangeOnATiltedEdgeFollowsThePower) {
  Target target;
  const PrintedBoard board(target);
  Surface surface = board_at(3.0, board, target.nodes()[4].center_m);
  surface.u = Eigen::Vector3d(0.5, -std::sqrt(0.75), 0.0);  // right edge farther away
  const Room room{{surface}, kZ};
  const RayCaster caster(room, Eigen::Vector3d::Zero());
  LidarOptions options;
  // On the right edge of the disc the light comes from the white, farther side.
  const Eigen::Vector3d edge =
      surface.center_m + target.circle_radius_m * surface.u +
      (target.nodes()[4].center_m - board.outline().center_m()).x() * surface.u;
  const double axis = edge.norm();
  double pulled = 0.0;
  for (int i = 0; i < 16; ++i) pulled += Beam(options, caster).fire(edge / axis, 0.4 * i).range_m;
  EXPECT_GT(pulled / 16.0, axis + 0.5e-3);
  options.range_follows_power = false;
  EXPECT_NEAR(Beam(options, caster).fire(edge / axis, 0.0).range_m, axis, 1e-9);
}

TEST(Scan, NoiseIsAsAskedFor) {
  for (const double reflectivity : {0.85, 0.085}) {
    const Room room{{panel(3.0, 20.0, reflectivity)}, kZ};
    const RayCaster caster(room, Eigen::Vector3d::Zero());
    LidarOptions options;
    options.points = 20'000;
    options.angle_sigma_deg = 0.0;
    const ScanPattern pattern(options, Random(1));
    const Cloud cloud = scan(options, pattern, caster, Random(2), {});
    ASSERT_EQ(cloud.size(), 20'000U);
    std::vector<double> range;
    std::vector<double> intensity;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d point = cloud.points_m[i].cast<double>();
      const double along = point.normalized().x();
      range.push_back(point.norm() - 3.0 / along);
      const double left = std::pow(along, options.incidence_exponent) *
                          std::pow(1.0 / along, -options.range_exponent);
      intensity.push_back(cloud.intensity[i] - 150.0 * reflectivity * left);
      ASSERT_EQ(cloud.intensity[i], std::round(cloud.intensity[i]));
    }
    const double expected = 0.008 * std::pow(0.85 / reflectivity, 0.3);
    EXPECT_NEAR(rms(range), expected, 0.02 * expected) << reflectivity;
    EXPECT_NEAR(rms(intensity), 4.0, 0.15);
  }
}

TEST(Scan, JitterMovesTheTrueDirectionNotTheReportedOne) {
  // A wall along the line of sight: jitter shows as range error, cot(incidence) times as large.
  Surface slanted = panel(0.0, 20.0, 0.85);
  slanted.center_m = {3.0, 0.0, 0.0};
  slanted.u = Eigen::Vector3d(std::sqrt(0.75), 0.5, 0.0);
  const Room room{{slanted}, kZ};
  const RayCaster caster(room, Eigen::Vector3d::Zero());
  LidarOptions options;
  options.points = 20'000;
  options.fov_deg = 10.0;
  options.range_sigma_m = 0.0;
  options.angle_sigma_deg = 0.05;
  const ScanPattern pattern(options, Random(1));
  const Cloud cloud = scan(options, pattern, caster, Random(2), {});
  const Eigen::Vector3d normal = slanted.normal();
  std::vector<double> errors;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d point = cloud.points_m[i].cast<double>();
    ASSERT_LT((point.normalized() - pattern.shot(i).direction).norm(), 1e-6);
    const double range = normal.dot(slanted.center_m) / normal.dot(point.normalized());
    const double cosine = std::abs(normal.dot(point.normalized()));
    const double tangent = std::sqrt(1.0 - cosine * cosine) / cosine;
    errors.push_back((point.norm() - range) / (range * tangent));
  }
  const double expected = 0.05 * std::numbers::pi / 180.0;
  EXPECT_NEAR(rms(errors), expected, 0.03 * expected);
}

TEST(Scan, StopsWhenAsked) {
  const Room room{{panel(3.0, 20.0, 0.5)}, kZ};
  const RayCaster caster(room, Eigen::Vector3d::Zero());
  LidarOptions options;
  const ScanPattern pattern(options, Random(1));
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(scan(options, pattern, caster, Random(2), stop.get_token()).size(), 0U);
}

}  // namespace
}  // namespace lvcalib::simulation
