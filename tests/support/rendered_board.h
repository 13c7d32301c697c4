// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "base/rigid3.h"
#include "camera/camera.h"
#include "detection/board_view.h"
#include "target/target.h"

namespace lvcalib::testing {

struct RenderOptions {
  double black = 40.0;
  double white = 190.0;
  double background = 110.0;
  double blur_px = 0.8;      ///< Gaussian, on top of the pixel's area.
  double noise = 2.0;        ///< Grey levels.
  double gamma = 1.0;        ///< Response of the camera, applied to the blurred light.
  int samples_per_side = 5;  ///< Samples along each side of a pixel.
  std::uint64_t seed = 1;
  /// Replaces the board's albedo where it returns a value, for things that hide the board.
  std::function<std::optional<double>(const Eigen::Vector2d& board_m)> cover;
};

/// What the camera sees of the board, by brute force: the albedo at many points of each pixel, a
/// Gaussian over these, the mean over the pixel, noise, rounding to whole grey levels.
GrayImage render_board(const Target& target, const Camera& camera, const Rigid3& camera_from_board,
                       const RenderOptions& options);

/// A pose that shows the middle of the board at `distance_m`, turned by angles about the camera's
/// axes: roll about z, tilt about x, pan about y. With all zero the board is upright and faces the
/// camera.
Rigid3 facing_pose(const Target& target, double distance_m, double roll_rad, double tilt_rad,
                   double pan_rad);

/// A distortion-free camera with its principal point in the middle.
Camera pinhole(int width_px, int height_px, double focal_px);

/// The folder with the shared data, if it is there: LVCALIB_SHARED_DATA or ../shared/data beside
/// the source folder.
std::optional<std::filesystem::path> shared_data();

}  // namespace lvcalib::testing
