// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "base/random.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "simulation/disturbances/camera.h"
#include "simulation/room.h"
#include "simulation/simulation_options.h"

namespace lvcalib::simulation {

/// An 8-bit grey image, row by row. Empty if the rendering was stopped.
struct SimulatedImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> pixels;
};

/// A camera in a room; refers to it and its place.
struct PlacedCamera {
  const Camera& camera;
  const Rigid3& camera_from_lidar;
  CameraDisturbance disturbance = {};  ///< How it differs from `camera`.
};

/// Photographs a room.
///
/// Light: reflectivity × (ambient + Lambert's law) × mild vignetting, linear up to saturation,
/// exposed so that white paper facing the lamp's mean has the white level. Around the board every
/// pixel is integrated over its area: on a grid of half pixels, each one sample where it lies on a
/// plain piece, 5 × 5 where an edge crosses it. The lens blur is applied on that grid too. Then
/// shot noise (√electrons) and read noise, and rounding to 8 bits.
SimulatedImage photograph(const ImageOptions& options, const PlacedCamera& by, const Room& room,
                          Random random, std::stop_token stop);

}  // namespace lvcalib::simulation
