// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "simulation/beam.h"
#include "simulation/disturbances/planted_effects.h"
#include "simulation/rig.h"

namespace lvcalib::simulation {

using Effects = std::map<std::string, double>;

/// A LiDAR without noise.
inline LidarOptions quiet(LidarKind kind) {
  LidarOptions lidar;
  lidar.kind = kind;
  lidar.points = kind == LidarKind::kSpinning ? 1800 * 128 : 30'000;
  lidar.range_sigma_m = 0.0;
  lidar.angle_sigma_deg = 0.0;
  lidar.intensity_sigma = 0.0;
  return lidar;
}

/// The effects planted in a rig with that LiDAR.
inline PlantedEffects plant(const Effects& effects, LidarKind kind = LidarKind::kAvia,
                            std::uint64_t seed = 1) {
  SimulationOptions options;
  options.seed = seed;
  options.lidar = quiet(kind);
  options.effects = effects;
  return plant_effects(options, random_camera(options.image, Random(seed)));
}

/// A plain upright wall through (x, 0, 0), turned about the z axis; faces the LiDAR at 0.
inline Surface wall(double x_m, double reflectivity, double turn_rad = 0.0) {
  Surface surface;
  surface.center_m = {x_m, 0.0, 0.0};
  surface.u = Eigen::Vector3d(std::sin(turn_rad), std::cos(turn_rad), 0.0);
  surface.v = Eigen::Vector3d::UnitZ();
  surface.half_u_m = 200.0;
  surface.half_v_m = 200.0;
  surface.texture = {Texture::Kind::kPlain, reflectivity, 0.0, 1.0, 0};
  return surface;
}

/// The cloud of one wall.
inline Cloud scan_wall(const Surface& surface, const PlantedEffects& planted, LidarKind kind,
                       double clock_s = 0.0) {
  const Room room{{surface}, Eigen::Vector3d::UnitZ()};
  const RayCaster caster(room, Eigen::Vector3d::Zero());
  const LidarOptions options = quiet(kind);
  const ScanPattern pattern(options, Random(7));
  return scan(options, pattern, caster, Random(8), {}, {planted, clock_s});
}

/// Where the LiDAR should have ranged the wall along a point's direction.
inline double true_range_m(const Surface& surface, const Eigen::Vector3d& point_m) {
  return surface.normal().dot(surface.center_m) / surface.normal().dot(point_m.normalized());
}

/// Mean reported − true range of points within `reach_rad` of the x axis.
inline double mean_range_error_m(const Surface& surface, const Cloud& cloud,
                                 double reach_rad = 0.05) {
  double sum = 0.0;
  int count = 0;
  for (const auto& reported : cloud.points_m) {
    const Eigen::Vector3d point = reported.cast<double>();
    if (point.normalized().x() < std::cos(reach_rad)) continue;
    sum += point.norm() - true_range_m(surface, point);
    ++count;
  }
  return count > 20 ? sum / count : NAN;
}

/// A board that faces the LiDAR, its centre on the x axis.
inline Surface facing_board(double range_m, const PrintedBoard& board) {
  Surface surface;
  surface.center_m = {range_m, 0.0, 0.0};
  surface.u = -Eigen::Vector3d::UnitY();
  surface.v = Eigen::Vector3d::UnitZ();
  surface.half_u_m = 0.5 * board.outline().size_m().x();
  surface.half_v_m = 0.5 * board.outline().size_m().y();
  surface.board = &board;
  return surface;
}

}  // namespace lvcalib::simulation
