// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Simulated scenes for tests that need a LiDAR cloud with a known board, and no image.

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "cloud/plane.h"
#include "simulation/simulator.h"

namespace lvcalib::test {

/// Options with the smallest image: only the cloud counts.
inline simulation::SimulationOptions cloud_only_options(std::uint64_t seed,
                                                        simulation::LidarKind kind) {
  simulation::SimulationOptions options;
  options.seed = seed;
  options.lidar.kind = kind;
  options.image.width_px = 320;
  options.image.height_px = 240;
  return options;
}

/// One simulated scene; the test fails and gets an empty scene if it cannot be made.
inline simulation::SimulatedScene simulated_scene(const simulation::SimulationOptions& options,
                                                  int scene = 0) {
  const auto simulator = simulation::Simulator::create(options);
  if (!simulator) {
    ADD_FAILURE() << simulator.error().text();
    return {};
  }
  auto result = simulator->simulate_scene(scene, {});
  if (!result) {
    ADD_FAILURE() << result.error().text();
    return {};
  }
  return std::move(*result);
}

/// Points about a board: within three quarters of its diagonal of the centre and near its plane.
inline Cloud points_about(const Cloud& cloud, const Target& target,
                          const Rigid3& lidar_from_board) {
  const BoardOutline outline = target.outline();
  const Eigen::Vector2d c = outline.center_m();
  const Eigen::Vector3d center = lidar_from_board * Eigen::Vector3d(c.x(), c.y(), 0.0);
  const Eigen::Vector3d normal = lidar_from_board.rotation * Eigen::Vector3d::UnitZ();
  Cloud out;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d d = cloud.points_m[i].cast<double>() - center;
    if (d.norm() < 0.75 * outline.size_m().norm() && std::abs(normal.dot(d)) < 0.08) {
      append_point(out, cloud, i);
    }
  }
  return out;
}

/// `pose` moved by `shift_m` in the board's plane and turned by `turn_rad` about an axis through
/// the board's centre, both in random directions.
inline Rigid3 off_by(const Rigid3& lidar_from_board, const Target& target, double shift_m,
                     double turn_rad, std::uint64_t seed) {
  Random random(seed);
  const double direction = random.uniform(0.0, 6.283185307179586);
  Eigen::Vector3d axis;
  for (double& v : axis) v = random.normal();
  const Eigen::Vector2d c = target.outline().center_m();
  const Eigen::Vector3d center(c.x(), c.y(), 0.0);
  const Eigen::Quaterniond turn = so3_exp(turn_rad * axis.normalized());
  const Eigen::Vector3d shift(shift_m * std::cos(direction), shift_m * std::sin(direction), 0.0);
  return lidar_from_board * Rigid3{turn, center + shift - turn * center};
}

}  // namespace lvcalib::test
