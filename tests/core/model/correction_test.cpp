// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/correction.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/statistics.h"
#include "support/simulated_boards.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;

// Scales as a calibration on these simulated boards would find them.
ModelScales usual_scales() {
  ModelScales scales;
  scales.level = {127.5, 12.0};
  scales.log_contrast = std::log(127.5 / 12.0);
  scales.incidence_high_rad = 1.0;
  scales.lines = {0, 1, 2, 3, 4, 5};
  return scales;
}

EffectInUse effect(const std::string& id, const std::vector<double>& values, double shape = 0.0) {
  return {
      find_effect(id), shape,
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()))};
}

// A wall square to the x axis, `count` points at `distance_m`, with all fields.
Cloud wall(double distance_m, std::size_t count = 400) {
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const double y = 0.01 * (static_cast<double>(i % 20) - 10.0);
    const double z = 0.01 * (static_cast<double>(i / 20) - 10.0);
    cloud.points_m.push_back(Eigen::Vector3d(distance_m, y, z).cast<float>());
    cloud.intensity.push_back(127.5F);
    cloud.time_s.push_back(1e-3F * static_cast<float>(i));
    cloud.line.push_back(static_cast<std::uint16_t>(i % 6));
  }
  return cloud;
}

// Of the distances between points: where a beam meets something else altogether does not count.
double median_between(const Cloud& a, const Cloud& b) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < a.size(); ++i)
    distances.push_back((a.points_m[i] - b.points_m[i]).cast<double>().norm());
  return median(std::move(distances));
}

double rms_between(const Cloud& a, const Cloud& b) {
  double squares = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    squares += (a.points_m[i] - b.points_m[i]).cast<double>().squaredNorm();
  return std::sqrt(squares / static_cast<double>(a.size()));
}

// One effect planted in the simulator's own physics, with the parameters it stands for.
struct PlantedCase {
  std::string id;
  double planted = 0.0;  // simulator's unit
  std::vector<double> values;
  double shape = 0.0;
  double share = 0.9;  // of the disturbance that is gone afterwards, median
};
std::ostream& operator<<(std::ostream& out, const PlantedCase& c) {
  return out << c.id;
}

class CorrectedCloud : public ::testing::TestWithParam<PlantedCase> {};

TEST_P(CorrectedCloud, IsNearerToTheUndisturbedOneByTheEffectsShare) {
  auto options = test::cloud_only_options(7, simulation::LidarKind::kAvia);
  options.lidar.points = 40'000;
  const Cloud clean = test::simulated_scene(options).cloud;
  options.effects[GetParam().id] = GetParam().planted;
  Cloud cloud = test::simulated_scene(options).cloud;
  ASSERT_EQ(cloud.size(), clean.size());
  const double before = median_between(cloud, clean);
  ASSERT_GT(before, 1e-4);
  const auto summary = correct_cloud(
      cloud, {effect(GetParam().id, GetParam().values, GetParam().shape)}, usual_scales(), {}, {});
  ASSERT_TRUE(summary.ok()) << summary.error().text();
  const double after = median_between(cloud, clean);
  EXPECT_LT(after, (1.0 - GetParam().share) * before)
      << "before " << 1e3 * before << " mm, after " << 1e3 * after << " mm";
}

INSTANTIATE_TEST_SUITE_P(Planted, CorrectedCloud,
                         ::testing::Values(PlantedCase{"range_offset", 20.0, {0.02}, 0.0, 0.99},
                                           PlantedCase{"range_scale", 2000.0, {0.002}, 0.0, 0.99},
                                           PlantedCase{"range_near", 30.0, {0.03}, 1.5, 0.99},
                                           PlantedCase{"range_walk", 10.0, {0.01}, 2.25, 0.5}),
                         [](const auto& info) { return info.param.id; });

// Directions read wrong by a formula worked out here; the true place comes back.
struct AngleCase {
  std::string id;
  std::vector<double> values;
  std::function<Eigen::Vector2d(double az, double el, double range)>
      error_rad;  // azimuth, elevation
};
std::ostream& operator<<(std::ostream& out, const AngleCase& c) {
  return out << c.id;
}

class CorrectedDirection : public ::testing::TestWithParam<AngleCase> {};

TEST_P(CorrectedDirection, IsTheTrueOne) {
  const auto point = [](double az, double el, double range) {
    return Eigen::Vector3f((range * Eigen::Vector3d(std::cos(el) * std::cos(az),
                                                    std::cos(el) * std::sin(az), std::sin(el)))
                               .cast<float>());
  };
  Cloud cloud;
  std::vector<Eigen::Vector3f> truth;
  for (int k = 0; k < 60; ++k) {
    const double az = -1.4 + 0.047 * k;
    const double el = 0.25 * std::sin(0.9 * k);
    const double range = 1.5 + 0.1 * k;
    const Eigen::Vector2d e = GetParam().error_rad(az, el, range);
    truth.push_back(point(az, el, range));
    cloud.points_m.push_back(point(az + e.x(), el + e.y(), range));
    cloud.line.push_back(static_cast<std::uint16_t>(k % 6));
  }
  ASSERT_TRUE(
      correct_cloud(cloud, {effect(GetParam().id, GetParam().values)}, usual_scales(), {}, {})
          .ok());
  // Errors of the second order in the angle remain: 2 mrad of 2 mrad of 7 m.
  for (std::size_t k = 0; k < truth.size(); ++k)
    EXPECT_LT((cloud.points_m[k] - truth[k]).norm(), 1e-4F) << k;
}

INSTANTIATE_TEST_SUITE_P(
    Angles, CorrectedDirection,
    ::testing::Values(
        AngleCase{
            "angle_scale",
            {0.002, -0.001},
            [](double az, double el, double) { return Eigen::Vector2d(0.002 * az, -0.001 * el); }},
        AngleCase{"encoder_eccentricity",
                  {0.002, 0.001},
                  [](double az, double, double) {
                    return Eigen::Vector2d(0.002 * std::sin(az) + 0.001 * std::cos(az), 0.0);
                  }},
        AngleCase{"axis_wobble",
                  {0.001, 0.002},
                  [](double, double el, double) {
                    return Eigen::Vector2d(0.001 / std::cos(el) + 0.002 * std::tan(el), 0.0);
                  }},
        AngleCase{"beam_origin_offset",
                  {0.004, 0.002},
                  [](double, double el, double range) {
                    return Eigen::Vector2d(0.004 / range / std::cos(el), 0.002 / range);
                  }}),
    [](const auto& info) { return info.param.id; });

TEST(CorrectCloud, TakesOutTheRangeErrorOfSinglePointsByHand) {
  // 1 m + 1000 ppm of it + 5 mm: corrected to the metre, not to 1 m − 1000 ppm of 1.006 m.
  Cloud cloud;
  cloud.points_m.push_back({1.006F, 0.0F, 0.0F});
  const auto summary =
      correct_cloud(cloud, {effect("range_scale", {1e-3}), effect("range_offset", {5e-3})},
                    usual_scales(), {}, {});
  ASSERT_TRUE(summary.ok());
  EXPECT_NEAR(cloud.points_m[0].x(), 1.0, 2e-7);
  EXPECT_NEAR(summary->largest_m, 0.006, 1e-6);
  EXPECT_NEAR(summary->effects[0].rms_m, 0.001, 1e-6);
  EXPECT_NEAR(summary->effects[1].rms_m, 0.005, 1e-6);
}

TEST(CorrectCloud, WalkFollowsTheIntensityOfEachPointWithinTheBoardsRange) {
  Cloud cloud = wall(2.0, 5);
  // White, black, half-way in the logarithm, far darker than any print, no echo worth a number.
  const ModelScales scales = usual_scales();
  cloud.intensity = {127.5F, 12.0F, static_cast<float>(std::sqrt(127.5 * 12.0)), 0.1F, 0.0F};
  const Cloud before = cloud;
  const auto summary = correct_cloud(cloud, {effect("range_walk", {0.01})}, scales, {}, {});
  ASSERT_TRUE(summary.ok());
  const double expected[] = {0.0, 0.010, 0.005, 0.010, 0.010};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(before.points_m[i].norm() - cloud.points_m[i].norm(), expected[i], 2e-5) << i;
  }
  EXPECT_EQ(summary->held, 2U);
}

TEST(CorrectCloud, IncidenceComesFromTheSurfaceAboutAPoint) {
  // A floor 1 m below, seen from afar: sec θ = range / height.
  Cloud cloud;
  for (int i = 0; i < 60; ++i) {
    for (int k = 0; k < 60; ++k)
      cloud.points_m.push_back(
          {1.5F + 0.01F * static_cast<float>(i), 0.01F * static_cast<float>(k), -1.0F});
  }
  cloud.points_m.push_back({0.0F, 9.0F, 3.0F});  // alone
  const Cloud before = cloud;
  ModelScales scales = usual_scales();
  scales.incidence_high_rad = 1.4;
  const auto summary = correct_cloud(cloud, {effect("range_incidence", {0.005})}, scales, {}, {});
  ASSERT_TRUE(summary.ok());
  // The one alone, and corners of the floor with few neighbours.
  EXPECT_GE(summary->no_surface, 1U);
  EXPECT_LT(summary->no_surface, 40U);
  EXPECT_EQ(cloud.points_m.back(), before.points_m.back());
  for (std::size_t i = 600; i < 3000; i += 97) {
    const double range = before.points_m[i].cast<double>().norm();
    EXPECT_NEAR(range - cloud.points_m[i].cast<double>().norm(), 0.005 * (range - 1.0), 2e-5);
  }
}

TEST(CorrectCloud, EveryPointStaysInItsPlaceWithItsFields) {
  Cloud cloud = wall(2.0);
  cloud.rows = 20;
  cloud.points_m[3].setConstant(std::numeric_limits<float>::quiet_NaN());
  cloud.points_m[4].setZero();
  const Cloud before = cloud;
  const auto summary =
      correct_cloud(cloud, {effect("range_offset", {0.01}), effect("encoder_lag", {1e-5})},
                    usual_scales(), {}, {});
  ASSERT_TRUE(summary.ok());
  EXPECT_EQ(summary->points, before.size() - 2);
  EXPECT_EQ(cloud.rows, 20U);
  EXPECT_TRUE(std::isnan(cloud.points_m[3].x()));
  EXPECT_TRUE(cloud.points_m[4].isZero());
  EXPECT_EQ(cloud.intensity, before.intensity);
  EXPECT_EQ(cloud.time_s, before.time_s);
  EXPECT_EQ(cloud.line, before.line);
  for (std::size_t i = 5; i < cloud.size(); ++i) EXPECT_TRUE(cloud.points_m[i].allFinite());
}

TEST(CorrectCloud, LinesThatCalibrationDidNotSeeAreLeftAndCounted) {
  Cloud cloud = wall(2.0, 12);
  cloud.line[0] = 40;
  const auto summary =
      correct_cloud(cloud, {effect("channel_range_offset", {0.0, 0.01, 0.02, 0.03, 0.04, 0.05})},
                    usual_scales(), {}, {});
  ASSERT_TRUE(summary.ok());
  EXPECT_EQ(summary->unknown_line, 1U);
  const Cloud before = wall(2.0, 12);
  EXPECT_EQ(cloud.points_m[0], before.points_m[0]);
  for (std::size_t i = 1; i < 12; ++i) {
    EXPECT_NEAR(before.points_m[i].norm() - cloud.points_m[i].norm(),
                0.01 * static_cast<double>(i % 6), 1e-6);
  }
}

TEST(CorrectCloud, SaysWhatItCannotTakeOut) {
  Cloud cloud = wall(2.0);
  CorrectionOptions options;
  options.skip = {"range_scale"};
  const auto summary =
      correct_cloud(cloud,
                    {effect("range_scale", {1e-3}), effect("range_warmup", {0.01}, 0.4),
                     effect("boundary_range_pull", {1.0}), effect("corner_bias", {0.2}),
                     effect("board_bow", {1e-3, 0, 0})},
                    usual_scales(), options, {});
  ASSERT_TRUE(summary.ok());
  const CorrectionState expected[] = {CorrectionState::kSkipped, CorrectionState::kNoClock,
                                      CorrectionState::kBoardOnly, CorrectionState::kNoPoints,
                                      CorrectionState::kNoPoints};
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(summary->effects[k].state, expected[k]) << k;
  EXPECT_EQ(rms_between(cloud, wall(2.0)), 0.0);
  options.clock = 0.4;
  const auto with_clock =
      correct_cloud(cloud, {effect("range_scale", {1e-3}), effect("range_warmup", {0.01}, 0.4)},
                    usual_scales(), options, {});
  ASSERT_TRUE(with_clock.ok());
  EXPECT_NEAR(with_clock->rms_m, 0.01 * std::exp(-1.0), 1e-6);
}

TEST(CorrectCloud, RefusesCloudsWithoutTheFieldsNeeded) {
  const auto refused = [](Cloud cloud, const EffectInUse& use) {
    const auto summary = correct_cloud(cloud, {use}, usual_scales(), {}, {});
    EXPECT_FALSE(summary.ok());
    if (summary.ok()) return std::string();
    EXPECT_EQ(summary.error().kind, ErrorKind::kInput);
    return summary.error().text();
  };
  Cloud cloud = wall(2.0);
  cloud.time_s.clear();
  EXPECT_THAT(
      refused(cloud, effect("scan_motion", {0.01, 0.0, 0.0})),
      ::testing::AllOf(HasSubstr("scan_motion"), HasSubstr("no time"), HasSubstr("--skip")));
  EXPECT_THAT(refused(cloud, effect("encoder_lag", {1e-5})), HasSubstr("no time"));
  cloud = wall(2.0);
  cloud.line.clear();
  EXPECT_THAT(refused(cloud, effect("channel_range_offset", std::vector<double>(6, 0.01))),
              HasSubstr("no line"));
  cloud = wall(2.0);
  cloud.intensity.clear();
  EXPECT_THAT(refused(cloud, effect("range_walk", {0.01})), HasSubstr("no intensity"));
}

TEST(CorrectCloud, RefusesWrongOptions) {
  Cloud cloud = wall(2.0);
  CorrectionOptions options;
  options.skip = {"range_walk"};
  const auto skip =
      correct_cloud(cloud, {effect("range_offset", {0.01})}, usual_scales(), options, {});
  ASSERT_FALSE(skip.ok());
  EXPECT_EQ(skip.error().kind, ErrorKind::kUsage);
  options.skip.clear();
  options.clock = 1.5;
  const auto clock =
      correct_cloud(cloud, {effect("range_offset", {0.01})}, usual_scales(), options, {});
  ASSERT_FALSE(clock.ok());
  EXPECT_THAT(clock.error().text(), HasSubstr("0 to 1"));
}

TEST(CorrectCloud, StopsWhenAsked) {
  Cloud cloud = wall(2.0);
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  const auto summary =
      correct_cloud(cloud, {effect("range_offset", {0.01})}, usual_scales(), {}, context);
  ASSERT_FALSE(summary.ok());
  EXPECT_EQ(summary.error().kind, ErrorKind::kCancelled);
}

TEST(CorrectionReads, FindsWhatEveryEffectDependsOn) {
  const ModelScales scales = usual_scales();
  const auto reads = [&](const std::string& id, double shape = 0.0) {
    const EffectPtr found = find_effect(id);
    const auto n = static_cast<Eigen::Index>(found->parameters(empty_table(scales)).size());
    return correction_reads({found, shape, Eigen::VectorXd::Zero(n)}, scales);
  };
  EXPECT_TRUE(reads("range_walk").darkness);
  EXPECT_FALSE(reads("range_walk").incidence);
  EXPECT_TRUE(reads("range_walk", 2.0).incidence);
  EXPECT_TRUE(reads("range_incidence").incidence);
  EXPECT_TRUE(reads("range_warmup", 0.4).clock);
  EXPECT_TRUE(reads("channel_range_offset").line);
  EXPECT_TRUE(reads("channel_angle_offset").line);
  EXPECT_TRUE(reads("encoder_lag").scan);
  EXPECT_TRUE(reads("scan_motion").time);
  EXPECT_TRUE(reads("boundary_range_pull").board);
  EXPECT_FALSE(reads("boundary_range_pull").moves_points);
  for (const char* id : {"range_offset", "range_scale", "angle_scale", "axis_wobble",
                         "encoder_eccentricity", "beam_origin_offset"}) {
    const CorrectionReads r = reads(id);
    EXPECT_TRUE(r.moves_points) << id;
    EXPECT_FALSE(r.incidence || r.darkness || r.clock || r.time || r.line || r.board) << id;
  }
  for (const char* id : {"print_scale", "board_bow", "corner_bias", "blooming", "specular_lobe"})
    EXPECT_FALSE(reads(id, 0.12).moves_points) << id;
}

}  // namespace
}  // namespace lvcalib
