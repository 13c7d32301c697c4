// SPDX-License-Identifier: GPL-3.0-or-later
#include "design/predicted_scene.h"

#include <cmath>

#include <gtest/gtest.h>

#include "model/residuals.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

TEST(SensorsOf, MeasuresWhatTheTableWasMadeWith) {
  const auto made = test::synthetic_table({});
  const SensorModel sensors = sensors_of(made.table);
  EXPECT_NEAR(sensors.range_sigma_m, 0.008, 1e-6);
  EXPECT_NEAR(sensors.corner_sigma_px, 0.05, 1e-6);
  EXPECT_NEAR(sensors.intensity_sigma, 0.2, 1e-6);
  // All that was seen lies inside the field of view, with room around.
  for (const RangeRow& row : made.table.range) {
    EXPECT_GT(row.beam.azimuth_rad, sensors.azimuth_rad.x());
    EXPECT_LT(row.beam.azimuth_rad, sensors.azimuth_rad.y());
    EXPECT_GT(row.beam.elevation_rad, sensors.elevation_rad.x());
  }
  EXPECT_FALSE(sensors.traits.empty());
}

// Returns at even angles: a rectangle of directions, or the ellipse in it.
Cloud scanned(double azimuth_low, double azimuth_high, double elevation, bool round) {
  Cloud cloud;
  constexpr int kSteps = 120;
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; k <= kSteps; ++k) {
      const double x = 2.0 * i / kSteps - 1.0;
      const double y = 2.0 * k / kSteps - 1.0;
      if (round && x * x + y * y > 1.0) continue;
      const double a = 0.5 * (azimuth_low + azimuth_high) + 0.5 * x * (azimuth_high - azimuth_low);
      const double e = y * elevation;
      cloud.points_m.push_back(
          3.0F * Eigen::Vector3d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e))
                     .cast<float>());
    }
  }
  return cloud;
}

TEST(TakeFieldOfView, IsThatOfTheCloud) {
  SensorModel sensors;
  take_field_of_view(scanned(-0.6, 0.7, 0.4, false), sensors);
  EXPECT_NEAR(sensors.azimuth_rad.x(), -0.6, 0.03);
  EXPECT_NEAR(sensors.azimuth_rad.y(), 0.7, 0.03);
  EXPECT_NEAR(sensors.elevation_rad.x(), -0.4, 0.03);
  EXPECT_NEAR(sensors.elevation_rad.y(), 0.4, 0.03);
  EXPECT_FALSE(sensors.round);
  take_field_of_view(scanned(-0.6, 0.6, 0.6, true), sensors);
  EXPECT_TRUE(sensors.round);
  // Backwards, over the turn of the angle.
  take_field_of_view(scanned(2.8, 3.6, 0.3, false), sensors);
  EXPECT_NEAR(sensors.azimuth_rad.x(), 2.8, 0.03);
  EXPECT_NEAR(sensors.azimuth_rad.y(), 3.6, 0.03);
  take_field_of_view(scanned(-3.14, 3.14, 0.3, false), sensors);
  EXPECT_NEAR(sensors.azimuth_rad.y() - sensors.azimuth_rad.x(), 6.283, 1e-3);
  EXPECT_FALSE(sensors.round);
  // Too few to say anything.
  const SensorModel before = sensors;
  take_field_of_view(Cloud{}, sensors);
  EXPECT_EQ(sensors.elevation_rad, before.elevation_rad);
}

TEST(PredictedScene, PredictsItselfWithoutResidual) {
  const auto made = test::synthetic_table({});
  const SensorModel sensors = sensors_of(made.table);
  MeasurementTable table;
  table.target = made.table.target;
  table.camera = made.table.camera;
  table.print = made.table.print;
  table.log_contrast = made.table.log_contrast;
  table.has_intensity = true;
  table.level = made.table.level;
  ModelState state{made.truth.camera_from_lidar, {}};
  GridPose pose;
  pose.camera_from_board = made.truth.camera_from_board[2];
  append_predicted_scene(pose, sensors, table, state);
  ASSERT_EQ(state.camera_from_board.size(), 1U);
  for (const Channel channel : kAllChannels) {
    const auto residuals = residuals_of(table, state, {}, channel);
    EXPECT_FALSE(residuals.values.empty()) << name_of(channel);
    for (const double r : residuals.values) EXPECT_NEAR(r, 0.0, 1e-9) << name_of(channel);
  }
}

TEST(PredictedScene, PromisesAboutWhatASceneDelivers) {
  // The information of scenes taken against that predicted at their poses; of planes and corners,
  // as this table's edges are not where scans would have them.
  auto made = test::synthetic_table({});
  made.table.boundary.clear();
  made.table.intensity.clear();
  made.table.has_intensity = false;
  const SensorModel sensors = sensors_of(made.table);
  const EffectColumnsList none;
  const Linearization linear = linearize(made.table, made.truth, {}, none, {});
  std::vector<GridPose> poses(made.table.scenes.size());
  for (std::size_t s = 0; s < poses.size(); ++s)
    poses[s].camera_from_board = made.truth.camera_from_board[s];
  const ModelVariances variances;
  const auto predicted = predicted_information(
      poses, {sensors, made.table, made.truth.camera_from_lidar, none, {}, variances}, {});
  ASSERT_EQ(predicted.size(), poses.size());
  Matrix6d taken = Matrix6d::Zero();
  Matrix6d promised = Matrix6d::Zero();
  for (std::size_t s = 0; s < poses.size(); ++s) {
    taken += scene_term(linear.scenes[s], {}, variances).information;
    promised += predicted[s];
  }
  const Matrix6d a = taken.inverse();
  const Matrix6d b = promised.inverse();
  for (int k = 0; k < 6; ++k)
    EXPECT_NEAR(std::sqrt(b(k, k) / a(k, k)), 1.0, 0.3) << "direction " << k;
}

TEST(PredictedScene, StopsWhenAsked) {
  const auto made = test::synthetic_table({});
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  GridPose pose;
  pose.camera_from_board = made.truth.camera_from_board[0];
  EXPECT_TRUE(predicted_information(
                  {pose},
                  {sensors_of(made.table), made.table, made.truth.camera_from_lidar, {}, {}, {}},
                  context)
                  .empty());
}

TEST(LidarSees, OnlyFrontsInsideTheFieldOfView) {
  const Target target;
  SensorModel sensors;
  sensors.azimuth_rad << -0.5, 0.5;
  sensors.elevation_rad << -0.5, 0.5;
  // x forward: the board at 3 m with its front to the LiDAR.
  Eigen::Matrix3d facing;
  facing << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  const Eigen::Vector2d c = target.outline().center_m();
  const auto at = [&](const Eigen::Vector3d& center, const Eigen::Matrix3d& r) {
    return Rigid3::from_matrix(r, Eigen::Vector3d(center - r * Eigen::Vector3d(c.x(), c.y(), 0)));
  };
  EXPECT_TRUE(lidar_sees(sensors, target, at({3, 0, 0}, facing)));
  EXPECT_FALSE(lidar_sees(sensors, target, at({3, 1.5, 0}, facing)));
  EXPECT_FALSE(lidar_sees(sensors, target, at({-3, 0, 0}, facing)));
  const Eigen::Matrix3d back = facing * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY());
  EXPECT_FALSE(lidar_sees(sensors, target, at({3, 0, 0}, back)));
  // A corner of the rectangle lies outside the ellipse in it.
  EXPECT_TRUE(lidar_sees(sensors, target, at({3, 0.9, 0.9}, facing)));
  sensors.round = true;
  EXPECT_FALSE(lidar_sees(sensors, target, at({3, 0.9, 0.9}, facing)));
}

}  // namespace
}  // namespace lvcalib
