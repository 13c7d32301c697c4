// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "base/progress.h"
#include "base/rigid3.h"
#include "camera/camera.h"

namespace lvcalib {

/// Pixel of every LiDAR point under an extrinsic; NaN for points that the camera does not image
/// (behind it, outside the picture, beyond the model's reach). Runs on the context's threads; when
/// stopped, the rest stays NaN.
std::vector<Eigen::Vector2f> project_points(std::span<const Eigen::Vector3f> points_m,
                                            const Camera& camera, const Rigid3& camera_from_lidar,
                                            const RunContext& context);

/// The at most `count` pixels nearest to a place, within `radius_px`; nearest first.
std::vector<std::uint32_t> nearest_pixels(std::span<const Eigen::Vector2f> pixels,
                                          const Eigen::Vector2d& place_px, std::size_t count,
                                          double radius_px);

}  // namespace lvcalib
