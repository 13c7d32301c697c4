// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "base/error.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "simulation/scan_pattern.h"
#include "simulation/simulation_options.h"

namespace lvcalib::simulation {

/// lidar_from_board of one scene: fully in the image, in the LiDAR's field of view (or partly out
/// of it, if asked for), at the wanted distance. The first scene faces the rig, the following ones
/// are tilted in directions that differ as much as possible (golden angle), so that few scenes
/// already fix every direction. kUsage if the board fits nowhere.
Result<Rigid3> place_board(const SimulationOptions& options, const Camera& camera,
                           const Rigid3& camera_from_lidar, const ScanPattern& pattern, int scene,
                           Random random);

/// Points along the board's edge and over its area, in the board frame.
std::vector<Eigen::Vector3d> outline_points(const Target& target, int per_side);

}  // namespace lvcalib::simulation
