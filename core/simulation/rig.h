// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/random.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "simulation/simulation_options.h"

namespace lvcalib::simulation {

/// A camera with realistic intrinsics of the wanted size and distortion model. Its numbers are
/// rounded to what a calibration file holds, so that the file and the image agree exactly.
Camera random_camera(const ImageOptions& options, Random random);

/// camera_from_lidar of a camera bolted within 0.3 m of the LiDAR: the usual swap of axes (LiDAR
/// x forward, y left, z up; camera z forward, y down) turned by several degrees.
Rigid3 random_mount(Random random);

}  // namespace lvcalib::simulation
