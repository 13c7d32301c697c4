// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/point_picking.h"

#include <limits>

namespace lvcalib::widgets {

std::optional<std::size_t> pick_point(std::span<const float> xyz,
                                      const Eigen::Matrix4d& clip_from_world,
                                      const Eigen::Vector2d& viewport_px,
                                      const Eigen::Vector2d& place_px, double radius_px) {
  const Eigen::Matrix4f matrix = clip_from_world.cast<float>();
  const Eigen::Vector2f half = (0.5 * viewport_px).cast<float>();
  const Eigen::Vector2f place = place_px.cast<float>();
  const auto limit = static_cast<float>(radius_px * radius_px);
  std::optional<std::size_t> best;
  float best_score = std::numeric_limits<float>::max();
  for (std::size_t i = 0; 3 * i + 2 < xyz.size(); ++i) {
    const Eigen::Vector4f clip =
        matrix * Eigen::Vector4f(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2], 1.0F);
    if (!(clip.w() > 0.0F)) continue;  // Behind the viewer.
    const Eigen::Vector2f screen((1.0F + clip.x() / clip.w()) * half.x(),
                                 (1.0F - clip.y() / clip.w()) * half.y());
    const float off_sq = (screen - place).squaredNorm();
    if (!(off_sq <= limit)) continue;
    // A full radius off counts like one per cent more depth.
    const float score = clip.w() * (1.0F + 0.01F * off_sq / limit);
    if (score < best_score) {
      best_score = score;
      best = i;
    }
  }
  return best;
}

}  // namespace lvcalib::widgets
