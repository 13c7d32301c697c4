// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/disturbances/beam.h"

#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "planted.h"

namespace lvcalib::simulation {
namespace {

constexpr double kMiddle = 0.5 * (PrintedBoard::kBlack + PrintedBoard::kWhite);

// Where a rising function crosses a level, by bisection.
double crossing(const std::function<double(double)>& value, double level, double low, double high) {
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (value(middle) < level ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// A wall at 3 m, white on one side of the x axis (left or up) and black on the other.
Room two_tone(bool vertical_beam_axis) {
  Room room;
  for (const bool white : {true, false}) {
    Surface half = wall(3.0, white ? PrintedBoard::kWhite : PrintedBoard::kBlack);
    half.half_u_m = 50.0;
    half.half_v_m = 50.0;
    const Eigen::Vector3d side =
        vertical_beam_axis ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
    half.center_m += (white ? 50.0 : -50.0) * side;
    room.surfaces.push_back(half);
  }
  return room;
}

// The straight edge as a beam passes over it, shot by shot.
class Edge {
 public:
  explicit Edge(const Effects& effects, bool vertical = false)
      : vertical_(vertical),
        room_(two_tone(vertical)),
        beam_(options_, caster_, plant(effects).beam) {}

  [[nodiscard]] double reflectivity(double offset_m) const {
    const Eigen::Vector3d target =
        vertical_ ? Eigen::Vector3d(3.0, 0.0, offset_m) : Eigen::Vector3d(3.0, offset_m, 0.0);
    double sum = 0.0;
    for (int i = 0; i < kTurns; ++i) {
      sum += beam_.fire(target.normalized(), 2.0 * std::numbers::pi * i / kTurns).reflectivity;
    }
    return sum / kTurns;
  }
  [[nodiscard]] double middle_mm() const {
    return 1e3 * crossing([&](double x) { return reflectivity(x); }, kMiddle, -0.02, 0.02);
  }
  // Half the distance between the 16 % and 84 % levels of a Gaussian transition.
  [[nodiscard]] double sigma_mm() const {
    const double contrast = PrintedBoard::kWhite - PrintedBoard::kBlack;
    const auto at = [&](double share) {
      return crossing([&](double x) { return reflectivity(x); },
                      PrintedBoard::kBlack + share * contrast, -0.02, 0.02);
    };
    return 0.5e3 * (at(0.841345) - at(0.158655));
  }

 private:
  static constexpr int kTurns = 64;
  bool vertical_;
  LidarOptions options_ = quiet(LidarKind::kAvia);
  Room room_;
  RayCaster caster_{room_, Eigen::Vector3d::Zero()};
  Beam beam_;
};

TEST(BeamDisturbance, DivergenceReplacesTheOptions) {
  EXPECT_NEAR(Edge({}).sigma_mm(), 3.6, 0.1);
  EXPECT_NEAR(Edge({{"beam_divergence", 2.0}}).sigma_mm(), 6.0, 0.15);
  EXPECT_NEAR(Edge({{"beam_divergence", 2.0}}, true).sigma_mm(), 6.0, 0.15);
}

TEST(BeamDisturbance, AnisotropyIsTheDifferenceAroundTheSameMean) {
  const Effects effects = {{"footprint_anisotropy", -1.0}};
  EXPECT_NEAR(Edge(effects).sigma_mm(), 1.5, 0.08);
  EXPECT_NEAR(Edge(effects, true).sigma_mm(), 4.5, 0.12);
  const PlantedEffects wide = plant({{"footprint_anisotropy", 5.0}});
  const LidarOptions lidar;
  EXPECT_DOUBLE_EQ(wide.beam.horizontal_mrad(lidar), 5.0);
  EXPECT_DOUBLE_EQ(wide.beam.vertical_mrad(lidar), 0.0);
}

TEST(BeamDisturbance, BloomingMovesEdgesToTheDarkSide) {
  EXPECT_NEAR(Edge({}).middle_mm(), 0.0, 0.02);
  // White lies at positive offsets: −0.1 · 3.6 mm · ln(0.85/0.07) = −0.899 mm, −0.599 upright.
  EXPECT_NEAR(Edge({{"blooming", 0.1}}).middle_mm(), -0.899, 0.05);
  EXPECT_NEAR(Edge({{"blooming", 0.1}}, true).middle_mm(), -0.599, 0.05);
  EXPECT_NEAR(Edge({{"blooming", -0.1}}).middle_mm(), 0.899, 0.05);
  // Far from the edge the levels stay.
  const Edge edge({{"blooming", 0.3}});
  EXPECT_NEAR(edge.reflectivity(0.1), PrintedBoard::kWhite, 1e-9);
  EXPECT_NEAR(edge.reflectivity(-0.1), PrintedBoard::kBlack, 1e-9);
}

TEST(BeamDisturbance, BoundaryBiasMovesPrintedEdgesOutwards) {
  const Target target;
  const PrintedBoard board(target);
  const Room room{{facing_board(3.0, board)}, Eigen::Vector3d::UnitZ()};
  const RayCaster caster(room, Eigen::Vector3d::Zero());
  LidarOptions options = quiet(LidarKind::kAvia);
  options.beam_horizontal_mrad = 0.0;
  options.beam_vertical_mrad = 0.0;
  const Eigen::Vector2d center = target.nodes()[4].center_m - board.outline().center_m();
  for (const double bias : {2.0, 0.0, -2.0}) {
    const Effects effects = bias == 0.0 ? Effects{} : Effects{{"boundary_bias", bias}};
    const Beam beam(options, caster, plant(effects).beam);
    for (int i = 0; i < 16; ++i) {
      const double psi = 2.0 * std::numbers::pi * i / 16;
      const double radius = crossing(
          [&](double d) {
            const Eigen::Vector2d on_board =
                center + d * Eigen::Vector2d(std::cos(psi), std::sin(psi));
            const Eigen::Vector3d point(3.0, -on_board.x(), on_board.y());
            return beam.fire(point.normalized(), 0.0).reflectivity;
          },
          kMiddle, 0.03, 0.055);
      // Eight rim points follow a circle to 8 % of the shift.
      EXPECT_NEAR(1e3 * (radius - target.circle_radius_m), bias, 0.17) << i;
    }
  }
}

TEST(BeamDisturbance, RangePullGrowsByTheFactor) {
  const Target target;
  const PrintedBoard board(target);
  Surface surface = facing_board(3.0, board);
  surface.u = Eigen::Vector3d(0.5, -std::sqrt(0.75), 0.0);
  const Room room{{surface}, Eigen::Vector3d::UnitZ()};
  const RayCaster caster(room, Eigen::Vector3d::Zero());
  const LidarOptions options = quiet(LidarKind::kAvia);
  const Eigen::Vector2d node = target.nodes()[4].center_m - board.outline().center_m();
  const Eigen::Vector3d edge =
      surface.center_m + (target.circle_radius_m + node.x()) * surface.u + node.y() * surface.v;
  const auto pull = [&](double factor) {
    const Beam beam(options, caster, plant({{"boundary_range_pull", factor}}).beam);
    double sum = 0.0;
    for (int i = 0; i < 16; ++i) sum += beam.fire(edge.normalized(), 0.4 * i).range_m - edge.norm();
    return sum / 16.0;
  };
  const double natural = pull(1.0);
  EXPECT_GT(natural, 0.5e-3);
  EXPECT_NEAR(pull(3.0), 3.0 * natural, 1e-9);
  EXPECT_NEAR(pull(0.0), 0.0, 1e-9);
}

// Where a whole scan sees the edge of the wall: its points spread evenly, so the share of white
// among those within ±w tells.
double scanned_edge_mm(const Effects& effects, LidarKind kind, bool vertical) {
  const Room room = two_tone(vertical);
  const RayCaster caster(room, Eigen::Vector3d::Zero());
  LidarOptions options = quiet(kind);
  options.intensity_scale = 1e4;
  options.incidence_exponent = 0.0;
  options.range_exponent = 0.0;
  if (kind == LidarKind::kSpinning) options.points *= 5;  // Columns that fall between others.
  const ScanPattern pattern(options, Random(7));
  const Cloud cloud = scan(options, pattern, caster, Random(8), {}, {plant(effects, kind)});
  constexpr double kWidth = 0.04;
  double white = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f& point = cloud.points_m[i];
    const double along = vertical ? point.z() : point.y();
    const double beside = vertical ? point.y() : point.z();
    if (point.x() < 0.0F || std::abs(along) > kWidth || std::abs(beside) > 0.6) continue;
    white += (1e-4 * cloud.intensity[i] - PrintedBoard::kBlack) /
             (PrintedBoard::kWhite - PrintedBoard::kBlack);
    ++count;
  }
  EXPECT_GT(count, 100);
  return 1e3 * kWidth * (1.0 - 2.0 * white / count);
}

TEST(BeamDisturbance, FootprintOffsetShiftsThePrintNotTheRange) {
  const Effects effects = {{"footprint_offset", 1.0}};
  const double vertical_mrad = plant(effects).details.at("footprint_offset").at("vertical_mrad")[0];
  const double side = scanned_edge_mm(effects, LidarKind::kAvia, false) -
                      scanned_edge_mm({}, LidarKind::kAvia, false);
  const double up = scanned_edge_mm(effects, LidarKind::kAvia, true) -
                    scanned_edge_mm({}, LidarKind::kAvia, true);
  EXPECT_NEAR(side, 3.0, 0.2);
  EXPECT_NEAR(up, 3.0 * vertical_mrad, 0.2);
  const Surface slanted = wall(3.0, 0.5, 0.8);
  const Cloud cloud = scan_wall(slanted, plant(effects), LidarKind::kAvia);
  EXPECT_NEAR(mean_range_error_m(slanted, cloud), 0.0, 1e-6);
}

TEST(BeamDisturbance, DetectorLagShiftsThePrintAlongTheScan) {
  // Clockwise at 20π rad/s and 3 m: 188.5 m/s, 3.77 mm in 20 µs, towards −y.
  const double side = scanned_edge_mm({{"detector_lag", 20.0}}, LidarKind::kSpinning, false) -
                      scanned_edge_mm({}, LidarKind::kSpinning, false);
  EXPECT_NEAR(side, -3.77, 0.25);
  const double up = scanned_edge_mm({{"detector_lag", 20.0}}, LidarKind::kSpinning, true) -
                    scanned_edge_mm({}, LidarKind::kSpinning, true);
  EXPECT_NEAR(up, 0.0, 0.05);
}

TEST(BeamDisturbance, LagNodesHaveTheMomentsOfAnExponential) {
  double mass = 0.0;
  double mean = 0.0;
  double square = 0.0;
  for (const auto& lag : plant({{"detector_lag", 5.0}}).beam.lags()) {
    mass += lag.weight;
    mean += lag.weight * lag.delay_s;
    square += lag.weight * lag.delay_s * lag.delay_s;
  }
  EXPECT_NEAR(mass, 1.0, 1e-12);
  EXPECT_NEAR(mean, 5e-6, 1e-15);
  EXPECT_NEAR(square, 2 * 25e-12, 1e-20);
}

}  // namespace
}  // namespace lvcalib::simulation
