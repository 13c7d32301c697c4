// SPDX-License-Identifier: BSD-3-Clause
#include "camera/cloud_projection.h"

#include <algorithm>
#include <limits>

#include "base/parallel.h"

namespace lvcalib {

std::vector<Eigen::Vector2f> project_points(std::span<const Eigen::Vector3f> points_m,
                                            const Camera& camera, const Rigid3& camera_from_lidar,
                                            const RunContext& context) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr std::size_t kBlock = 16384;  // A few milliseconds: how soon a stop is noticed.
  std::vector<Eigen::Vector2f> pixels(points_m.size(), Eigen::Vector2f(kNan, kNan));
  const Eigen::Matrix3d R = camera_from_lidar.rotation.toRotationMatrix();
  const std::size_t blocks = (points_m.size() + kBlock - 1) / kBlock;
  parallel_for(blocks, context.thread_count(), [&](std::size_t block) {
    if (context.stopped()) return;
    const std::size_t end = std::min(points_m.size(), (block + 1) * kBlock);
    for (std::size_t i = block * kBlock; i < end; ++i) {
      const Eigen::Vector3d p = R * points_m[i].cast<double>() + camera_from_lidar.translation;
      const auto pixel = camera.project(p);
      if (pixel && camera.in_image(*pixel)) pixels[i] = pixel->cast<float>();
    }
  });
  return pixels;
}

std::vector<std::uint32_t> nearest_pixels(std::span<const Eigen::Vector2f> pixels,
                                          const Eigen::Vector2d& place_px, std::size_t count,
                                          double radius_px) {
  const Eigen::Vector2f place = place_px.cast<float>();
  const auto limit = static_cast<float>(radius_px * radius_px);
  std::vector<std::pair<float, std::uint32_t>> near;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const float distance_sq = (pixels[i] - place).squaredNorm();
    // A NaN is not within any distance.
    if (distance_sq <= limit) near.emplace_back(distance_sq, static_cast<std::uint32_t>(i));
  }
  const std::size_t kept = std::min(count, near.size());
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(kept), near.end());
  std::vector<std::uint32_t> out;
  for (std::size_t k = 0; k < kept; ++k) out.push_back(near[k].second);
  return out;
}

}  // namespace lvcalib
