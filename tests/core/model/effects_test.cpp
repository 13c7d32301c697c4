// SPDX-License-Identifier: GPL-3.0-or-later
// Every effect of the catalogue at one place where its formula can be worked out by hand, in sign
// and size; and its parameters' units.
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "model/effect.h"
#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

using Eigen::Vector3d;

// 4 m straight ahead, board turned by 60°; white 30, black 10.
struct Place {
  MeasurementTable table;
  BeamPoint beam;
  BoundaryRow edge;
  CornerRow corner;
  IntensityRow intensity;
  PrintPoint print;
  Eigen::Vector2d normalized{0.3, 0.4};

  Place() {
    table.camera = test::test_camera();
    table.camera.fx = table.camera.fy = 1000.0;
    table.scenes.push_back({"A", {}, 0.4});
    table.lines = {0, 2, 5};
    table.has_time = table.has_intensity = true;
    table.level = {30.0, 10.0};
    table.log_contrast = std::log(16.0);
    beam.range_m = 4.0;
    beam.incidence_rad = M_PI / 3.0;
    beam.darkness = 0.5;
    beam.time_s = 0.02;
    beam.line = 2;
    beam.scan_rad_s = {30.0, -10.0};
    edge.beam = beam;
    edge.beam.incidence_rad = M_PI / 4.0;
    edge.transition_m = 0.01;
    edge.edge_normal_rad = {2.4, 3.2};
    edge.log_contrast = 2.0;
    corner.pixel = {200.0, 0.75 * table.camera.height_px};
    corner.from_tag_px = {3.0, 4.0};
    intensity.beam = beam;
    intensity.beam.range_m = std::exp(1.0);
    intensity.print = Print::kBlack;
    const BoardOutline outline = table.target.outline();
    print.board_m = outline.center_m() + Eigen::Vector2d(0.25, -0.5).cwiseProduct(outline.size_m());
  }

  void look(double azimuth_rad, double elevation_rad) {
    beam.azimuth_rad = azimuth_rad;
    beam.elevation_rad = elevation_rad;
    beam.direction = {std::cos(elevation_rad) * std::cos(azimuth_rad),
                      std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)};
  }
};

enum class Hook { kLidar, kSpot, kBlur, kEdge, kBoard, kCamera, kIntensity };

struct HandCase {
  std::string name;
  std::string id;
  Hook hook = Hook::kLidar;
  std::vector<Vector3d> expected;  // per parameter; scalars and pixels in the first entries
  double shape = 0.0;
  std::function<void(Place&)> at = [](Place&) {};
};
std::ostream& operator<<(std::ostream& out, const HandCase& c) {
  return out << c.name;
}

std::vector<Vector3d> moved_by(const Effect& effect, const HandCase& c, const Place& p) {
  const std::size_t n = effect.parameters(p.table).size();
  std::vector<Vector3d> moves(n, Vector3d::Zero());
  std::vector<Eigen::Vector2d> pixels(n, Eigen::Vector2d::Zero());
  std::vector<double> scalars(n, 0.0);
  switch (c.hook) {
    case Hook::kLidar:
      effect.lidar(p.beam, p.table, c.shape, moves);
      return moves;
    case Hook::kSpot:
      effect.spot(p.beam, p.table, c.shape, moves);
      return moves;
    case Hook::kBlur:
      effect.blur(p.beam, p.table, c.shape, moves);
      return moves;
    case Hook::kBoard:
      effect.board(p.print, p.table.target, c.shape, moves);
      return moves;
    case Hook::kCamera:
      effect.camera(p.corner, p.normalized, p.table.camera, c.shape, pixels);
      for (std::size_t k = 0; k < n; ++k) moves[k].head<2>() = pixels[k];
      return moves;
    case Hook::kEdge:
      effect.edge(p.edge, p.table, c.shape, scalars);
      break;
    case Hook::kIntensity:
      effect.intensity(p.intensity, p.table, c.shape, scalars);
      break;
  }
  for (std::size_t k = 0; k < n; ++k) moves[k].x() = scalars[k];
  return moves;
}

class ByHand : public ::testing::TestWithParam<HandCase> {};

TEST_P(ByHand, MovesWhatIsMeasuredAsTheFormulaSays) {
  const HandCase& c = GetParam();
  Place place;
  c.at(place);
  const EffectPtr effect = find_effect(c.id);
  ASSERT_NE(effect, nullptr);
  const auto moved = moved_by(*effect, c, place);
  ASSERT_EQ(moved.size(), c.expected.size());
  for (std::size_t k = 0; k < moved.size(); ++k) {
    EXPECT_LT((moved[k] - c.expected[k]).norm(), 1e-5 * (1.0 + c.expected[k].norm()))
        << "parameter " << k << ": " << moved[k].transpose();
  }
}

Vector3d along_x(double v) {
  return {v, 0.0, 0.0};
}

std::vector<HandCase> range_cases() {
  const auto near_edge = [](Place& p) {
    p.beam.incidence_rad = M_PI / 6.0;
    p.beam.edge = NearEdge{0.0, 0.0, 0.01};
  };
  return {
      {"Offset", "range_offset", Hook::kLidar, {along_x(1.0)}},
      {"Scale", "range_scale", Hook::kLidar, {along_x(4.0)}},
      {"WalkLogarithm", "range_walk", Hook::kLidar, {along_x(0.5)}},
      // Exponent ½ of a contrast of 16: (4^½ − 1) / (4 − 1).
      {"WalkPower", "range_walk", Hook::kLidar, {along_x(1.0 / 3.0)}, 0.5},
      // Half the light at 60°: a quarter of the contrast more.
      {"WalkByGeometry",
       "range_walk",
       Hook::kLidar,
       {along_x(0.75)},
       2.0,
       [](Place& p) { p.beam.range_m = 3.0; }},
      {"Incidence", "range_incidence", Hook::kLidar, {along_x(1.0)}},
      // A quarter of the period.
      {"Cyclic", "range_cyclic", Hook::kLidar, {along_x(1.0), along_x(0.0)}, 16.0},
      {"Near", "range_near", Hook::kLidar, {along_x(0.5)}, 4.0 / std::log(2.0)},
      {"Warmup", "range_warmup", Hook::kLidar, {along_x(0.5)}, 0.4 / std::log(2.0)},
      // At 2 s with a decay of 2 s / ln 2: half of a τ.
      {"Drift",
       "range_drift",
       Hook::kLidar,
       {along_x(1.0 / std::log(2.0))},
       2.0 / std::log(2.0),
       [](Place& p) { p.beam.time_s = 2.0; }},
      {"LineOffset",
       "channel_range_offset",
       Hook::kLidar,
       {along_x(0.0), along_x(1.0), along_x(0.0)}},
      // White at 3 m and 60° sends half of what it does squarely: twice the limit, black nothing.
      {"Saturated",
       "receiver_saturation",
       Hook::kLidar,
       {along_x(std::log(2.0)), along_x(0.0)},
       std::log(0.25),
       [](Place& p) { p.beam.range_m = 3.0; }},
      {"NotSaturated",
       "receiver_saturation",
       Hook::kLidar,
       {along_x(0.0), along_x(0.0)},
       std::log(0.25),
       [](Place& p) {
         p.beam.range_m = 3.0;
         p.beam.white = 0.0;
       }},
      // Half of the variance is jitter's: the mean of ln 2ρ over what lies above 1/2.
      {"SaturatedAtTimes",
       "receiver_saturation",
       Hook::kLidar,
       {along_x(32.0 / 31.0 * (std::log(2.0) - 0.5)), along_x(0.0)},
       std::log(0.5),
       [](Place& p) {
         p.table.scenes[0].middle_range_m = 3.0;
         p.beam.range_m = 3.0;
         p.beam.incidence_rad = 0.0;
         p.beam.white = 0.5;
         p.beam.jitter_share = 0.5;
         p.table.placed_by.levels = {{32.0, 2.0, {}}};
       }},
      // ½ · 0.01 m · pdf(0) · (20/20).
      {"RangePull",
       "boundary_range_pull",
       Hook::kLidar,
       {along_x(0.5 * 0.01 * 0.3989423)},
       0.0,
       near_edge},
  };
}

std::vector<HandCase> angle_cases() {
  const auto to_the_left = [](Place& p) { p.look(M_PI / 2.0, 0.0); };
  const auto up = [](Place& p) { p.look(0.0, M_PI / 6.0); };
  return {
      {"Zero", "angle_zero", Hook::kLidar, {{0, 4, 0}, {0, 0, 4}}},
      {"AzimuthScale",
       "angle_scale",
       Hook::kLidar,
       {{-2.0 * M_PI, 0, 0}, {0, 0, 0}},
       0.0,
       to_the_left},
      // 30° of elevation: 4 m · π/6 upwards, square to the beam.
      {"ElevationScale",
       "angle_scale",
       Hook::kLidar,
       {{0, 0, 0}, {-M_PI / 3.0, 0, std::sqrt(3.0) * M_PI / 3.0}},
       0.0,
       up},
      {"Eccentricity",
       "encoder_eccentricity",
       Hook::kLidar,
       {{-4, 0, 0}, {0, 0, 0}},
       0.0,
       to_the_left},
      {"Wobble", "axis_wobble", Hook::kLidar, {{0, 4, 0}, {0, 2, 0}}, 0.0, up},
      {"LineAngles",
       "channel_angle_offset",
       Hook::kLidar,
       {{0, 0, 0}, {0, 0, 4}, {0, 0, 0}, {0, 0, 0}, {0, 4, 0}, {0, 0, 0}}},
      {"BeamOrigin", "beam_origin_offset", Hook::kLidar, {{0, 1, 0}, {0, 0, 1}}},
      {"EncoderLag", "encoder_lag", Hook::kLidar, {{0, 120, -40}}},
      {"ScanMotion", "scan_motion", Hook::kLidar, {{0.02, 0, 0}, {0, 0.02, 0}, {0, 0, 0.02}}},
  };
}

std::vector<HandCase> edge_cases() {
  return {
      {"Bias", "boundary_bias", Hook::kEdge, {along_x(1.0)}},
      {"InkGain", "ink_gain", Hook::kEdge, {along_x(1.0)}},
      {"Divergence", "beam_divergence", Hook::kBlur, {{1, 0, 1}}},
      {"Anisotropy", "footprint_anisotropy", Hook::kBlur, {{0.5, 0, -0.5}}},
      {"FootprintOffset", "footprint_offset", Hook::kSpot, {{0, 4, 0}, {0, 0, 4}}},
      {"Blooming", "blooming", Hook::kEdge, {along_x(-0.02)}},
      {"DetectorLag", "detector_lag", Hook::kEdge, {along_x(40.0)}},
  };
}

std::vector<HandCase> intensity_cases() {
  const auto white = [](Place& p) { p.intensity.print = Print::kWhite; };
  const auto half_white = [](Place& p) {
    p.table.scenes[0].middle_range_m = 3.0;
    p.intensity.beam.range_m = 3.0;
    p.intensity.beam.incidence_rad = 0.0;
    p.intensity.beam.white = 0.5;
    p.table.placed_by.levels = {{32.0, 2.0, {}}};
  };
  return {
      // A quarter of white, four fifths of the way to black: ln ¼ + 0.8 · (1/16) · ln 16 / ¼.
      {"Nonlinearity",
       "intensity_nonlinearity",
       Hook::kIntensity,
       {along_x(std::log(0.25) + 0.2 * std::log(16.0))}},
      // Gains of the second and third line relative to the first; the point is of the second.
      {"Geometry",
       "intensity_geometry",
       Hook::kIntensity,
       {along_x(std::log(0.5)), along_x(-1.0), along_x(1.0), along_x(0.0)}},
      {"LobeBlack", "specular_lobe", Hook::kIntensity, {along_x(3.0 * std::exp(-0.5))}, M_PI / 3.0},
      {"LobeWhite",
       "specular_lobe",
       Hook::kIntensity,
       {along_x(std::exp(-0.5))},
       M_PI / 3.0,
       white},
      // Where the middle of the board is clipped to one half, print that sends half is not.
      {"SaturationWhite",
       "receiver_saturation",
       Hook::kIntensity,
       {along_x(0.0), along_x(std::log(2.0))},
       std::log(0.5),
       [](Place& p) {
         p.table.scenes[0].middle_range_m = 3.0;
         p.intensity.beam.range_m = 3.0;
       }},
      // Black sends 1/32 (half of what the contrast of clipped white says), so half of it 33/64,
      // clipped to 1/2 too; the straight line between the levels is at 17/64.
      {"SaturationMixture",
       "receiver_saturation",
       Hook::kIntensity,
       {along_x(0.0), along_x(std::log(32.0 / 17.0))},
       std::log(0.5),
       half_white},
      // Half of the variance is jitter's: single returns see all shares of white alike often.
      {"SaturationOfReturnsThatJitter",
       "receiver_saturation",
       Hook::kIntensity,
       {along_x(0.0), along_x(std::log(0.3865927 * 64.0 / 17.0))},
       std::log(0.5),
       [half_white](Place& p) {
         half_white(p);
         p.intensity.beam.jitter_share = 0.5;
       }},
  };
}

std::vector<HandCase> print_and_camera_cases() {
  const auto straight_lens = [](double k1) {
    return [k1](Place& p) {
      p.table.camera.distortion.setZero();
      p.table.camera.distortion(0) = k1;
    };
  };
  const auto beside_center = [](Place& p) {
    p.print.board_m = p.table.target.outline().center_m() + Eigen::Vector2d(0.1, 0.2);
  };
  return {
      {"Bow", "board_bow", Hook::kBoard, {{0, 0, 0.75}, {0, 0, 0}, {0, 0, -0.5}}},
      {"PrintScale",
       "print_scale",
       Hook::kBoard,
       {{0.1, 0.2, 0}, {0.1, -0.2, 0}, {0.2, 0.1, 0}},
       0.0,
       beside_center},
      {"Intrinsics", "intrinsics_error", Hook::kCamera, {{0.3, 0.4, 0}, {1, 0, 0}, {0, 1, 0}}},
      {"Distortion",
       "distortion_residual",
       Hook::kCamera,
       {{75, 100, 0}, {240, 570, 0}, {430, 240, 0}}},
      {"CornerBias", "corner_bias", Hook::kCamera, {{0.6, 0.8, 0}}},
      {"Shutter",
       "rolling_shutter",
       Hook::kCamera,
       {{0.8175, 0.09, 0}, {0.09, 0.87, 0}},
       0.0,
       straight_lens(0.0)},
      // k1 = -0.1 at r² = 0.25: the lens shrinks by 0.975 and by 2 k1 x xᵀ along the radius.
      {"ShutterBehindABentLens",
       "rolling_shutter",
       Hook::kCamera,
       {{0.7801875, 0.06525, 0}, {0.06525, 0.81825, 0}},
       0.0,
       straight_lens(-0.1)},
  };
}

const auto name_of_case = [](const auto& info) { return info.param.name; };
INSTANTIATE_TEST_SUITE_P(Range, ByHand, ::testing::ValuesIn(range_cases()), name_of_case);
INSTANTIATE_TEST_SUITE_P(Angle, ByHand, ::testing::ValuesIn(angle_cases()), name_of_case);
INSTANTIATE_TEST_SUITE_P(Edge, ByHand, ::testing::ValuesIn(edge_cases()), name_of_case);
INSTANTIATE_TEST_SUITE_P(Intensity, ByHand, ::testing::ValuesIn(intensity_cases()), name_of_case);
INSTANTIATE_TEST_SUITE_P(PrintAndCamera, ByHand, ::testing::ValuesIn(print_and_camera_cases()),
                         name_of_case);

TEST(Catalogue, EveryEffectIsWorkedOutByHand) {
  std::set<std::string> done;
  for (const auto& cases :
       {range_cases(), angle_cases(), edge_cases(), intensity_cases(), print_and_camera_cases()}) {
    for (const HandCase& c : cases) done.insert(c.id);
  }
  for (const EffectPtr& effect : effect_catalogue())
    EXPECT_TRUE(done.contains(effect->info().id)) << effect->info().id;
}

TEST(Catalogue, UnitsSayWhatTheirFactorsAre) {
  const std::map<std::string, double> factors = {{"mm", 1e-3}, {"ppm", 1e-6},  {"mrad", 1e-3},
                                                 {"µs", 1e-6}, {"mm/s", 1e-3}, {"px", 1.0},
                                                 {"1", 1.0},   {"mrad²", 1e-6}};
  for (const EffectPtr& effect : effect_catalogue()) {
    for (const EffectParameter& p : effect->parameters(Place().table)) {
      const std::string where = effect->info().id + " " + p.name;
      ASSERT_TRUE(factors.contains(p.unit)) << where << " " << p.unit;
      EXPECT_EQ(p.unit_in_si, factors.at(p.unit)) << where;
      // What matters lies within what is believable.
      EXPECT_GT(p.size_of_interest, 0.0) << where;
      EXPECT_GT(p.prior_sigma, p.size_of_interest) << where;
    }
  }
}

}  // namespace
}  // namespace lvcalib
