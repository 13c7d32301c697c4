// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A grey sheet before a part of a simulated board: a post, a card, a hand.

#include <cmath>
#include <functional>

#include "simulation/simulator.h"

namespace lvcalib::test {

/// Calls with every point's place on the board, where it is on or before the board.
inline void for_board_points(
    simulation::SimulatedScene& scene, const BoardOutline& outline,
    const std::function<void(const Eigen::Vector2d&, Eigen::Vector3f&, float&)>& change) {
  const Rigid3 board_from_lidar = scene.lidar_from_board.inverse();
  for (std::size_t i = 0; i < scene.cloud.size(); ++i) {
    const Eigen::Vector3d p = board_from_lidar * scene.cloud.points_m[i].cast<double>().eval();
    if (std::abs(p.z()) > 0.05 || !outline.contains(p.head<2>())) continue;
    change(p.head<2>(), scene.cloud.points_m[i], scene.cloud.intensity[i]);
  }
}

/// Covers a part of a scene's board, beyond whose edge the picture of it may reach, in cloud and
/// image by a grey sheet that is nearer to the LiDAR by so much.
inline void cover_part(simulation::SimulatedRig& rig, std::size_t index, const BoardOutline& part,
                       float nearer_m) {
  simulation::SimulatedScene& scene = rig.scenes[index];
  for_board_points(scene, rig.target.outline(),
                   [&](const Eigen::Vector2d& at, Eigen::Vector3f& p, float& i) {
                     if (!part.contains(at)) return;
                     p *= (p.norm() - nearer_m) / p.norm();
                     i = 40.0F;
                   });
  const Rigid3 board_from_camera = scene.camera_from_board.inverse();
  const auto width = static_cast<std::size_t>(scene.image.width_px);
  for (std::size_t k = 0; k < scene.image.pixels.size(); ++k) {
    const auto ray = rig.camera.unproject(
        Eigen::Vector2d(static_cast<double>(k % width), static_cast<double>(k / width)));
    if (!ray) continue;
    const Eigen::Vector3d d = board_from_camera.rotation * *ray;
    const Eigen::Vector3d& o = board_from_camera.translation;
    if (part.contains((o - o.z() / d.z() * d).head<2>())) scene.image.pixels[k] = 90;
  }
}

}  // namespace lvcalib::test
