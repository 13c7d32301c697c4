// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/point_picking.h"

#include <limits>

namespace lvcalib::widgets {
namespace {

// Where points appear on the screen, in pixels from the top left, and their depth.
class ScreenProjection {
 public:
  ScreenProjection(const Eigen::Matrix4d& clip_from_world, const Eigen::Vector2d& viewport_px)
      : matrix_(clip_from_world.cast<float>()), half_((0.5 * viewport_px).cast<float>()) {}

  struct Place {
    Eigen::Vector2f screen_px;
    float depth;
  };
  // Of three numbers; nothing behind the viewer.
  [[nodiscard]] std::optional<Place> of(const float* xyz) const {
    const Eigen::Vector4f clip = matrix_ * Eigen::Vector4f(xyz[0], xyz[1], xyz[2], 1.0F);
    if (!(clip.w() > 0.0F)) return std::nullopt;
    return Place{
        {(1.0F + clip.x() / clip.w()) * half_.x(), (1.0F - clip.y() / clip.w()) * half_.y()},
        clip.w()};
  }

 private:
  Eigen::Matrix4f matrix_;
  Eigen::Vector2f half_;
};

}  // namespace

std::optional<std::size_t> pick_point(std::span<const float> xyz,
                                      const Eigen::Matrix4d& clip_from_world,
                                      const Eigen::Vector2d& viewport_px,
                                      const Eigen::Vector2d& place_px, double radius_px) {
  const ScreenProjection projection(clip_from_world, viewport_px);
  const Eigen::Vector2f place = place_px.cast<float>();
  const auto limit = static_cast<float>(radius_px * radius_px);
  std::optional<std::size_t> best;
  float best_score = std::numeric_limits<float>::max();
  for (std::size_t i = 0; 3 * i + 2 < xyz.size(); ++i) {
    const auto seen = projection.of(&xyz[3 * i]);
    if (!seen) continue;
    const float off_sq = (seen->screen_px - place).squaredNorm();
    if (!(off_sq <= limit)) continue;
    // A full radius off counts like one per cent more depth.
    const float score = seen->depth * (1.0F + 0.01F * off_sq / limit);
    if (score < best_score) {
      best_score = score;
      best = i;
    }
  }
  return best;
}

std::vector<std::size_t> points_inside(std::span<const float> xyz,
                                       const Eigen::Matrix4d& clip_from_world,
                                       const Eigen::Vector2d& viewport_px, const LassoMask& mask) {
  const ScreenProjection projection(clip_from_world, viewport_px);
  std::vector<std::size_t> out;
  for (std::size_t i = 0; 3 * i + 2 < xyz.size(); ++i) {
    const auto seen = projection.of(&xyz[3 * i]);
    if (seen && mask.contains(static_cast<double>(seen->screen_px.x()),
                              static_cast<double>(seen->screen_px.y())))
      out.push_back(i);
  }
  return out;
}

}  // namespace lvcalib::widgets
