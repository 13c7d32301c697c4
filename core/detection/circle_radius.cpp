// SPDX-License-Identifier: BSD-3-Clause
#include "detection/circle_radius.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "base/statistics.h"

namespace lvcalib {
namespace {

constexpr int kSteps = 64;
constexpr int kPlaces = 24;  // About a circle, or a tag.

std::optional<double> grey_at(const GrayImage& image, const Eigen::Vector2d& pixel) {
  const double x = std::floor(pixel.x());
  const double y = std::floor(pixel.y());
  if (!(x >= 0.0 && y >= 0.0 && x + 1.0 < image.width_px && y + 1.0 < image.height_px))
    return std::nullopt;
  const int i = static_cast<int>(x);
  const int j = static_cast<int>(y);
  const double u = pixel.x() - x;
  const double v = pixel.y() - y;
  return (1.0 - v) * ((1.0 - u) * image.at(i, j) + u * image.at(i + 1, j)) +
         v * ((1.0 - u) * image.at(i, j + 1) + u * image.at(i + 1, j + 1));
}

// How far from a place the black of the print ends, along the way that leads out of it: where the
// grey level first crosses the middle between its darkest and brightest within `half_m` to either
// side. Nothing where the image does not show that.
std::optional<double> edge_offset_m(const GrayImage& image, const Camera& camera,
                                    const Rigid3& camera_from_board, const Eigen::Vector2d& place_m,
                                    const Eigen::Vector2d& outwards, double half_m) {
  std::vector<double> levels;
  for (int k = 0; k <= kSteps; ++k) {
    const Eigen::Vector2d p = place_m + (2.0 * k / kSteps - 1.0) * half_m * outwards;
    const auto pixel = camera.project(camera_from_board * Eigen::Vector3d(p.x(), p.y(), 0.0));
    const auto grey = pixel ? grey_at(image, *pixel) : std::nullopt;
    if (!grey) return std::nullopt;
    levels.push_back(*grey);
  }
  const auto brightest = std::max_element(levels.begin(), levels.end());
  const double dark = *std::min_element(levels.begin(), brightest + 1);
  const double middle = 0.5 * (dark + *brightest);
  // Eight bits hold an edge to some hundredths of its contrast from here on.
  constexpr double kFewestLevels = 20.0;
  if (*brightest - dark < kFewestLevels || levels.front() > middle) return std::nullopt;
  for (auto at = levels.begin() + 1; at <= brightest; ++at) {
    if (*at < middle) continue;
    const double before = *(at - 1);
    const double step = static_cast<double>(at - 1 - levels.begin()) +
                        (middle - before) / std::max(1e-9, *at - before);
    return (2.0 * step / kSteps - 1.0) * half_m;
  }
  return std::nullopt;
}

}  // namespace

MeasuredRadius measure_circle_radius(const GrayImage& image, const Target& target,
                                     const Camera& camera, const Rigid3& camera_from_board) {
  if (!target.has_circles()) return {};
  const double radius = target.circle_radius_m;
  const auto offset = [&](const Eigen::Vector2d& place, const Eigen::Vector2d& outwards,
                          double half_m) {
    return edge_offset_m(image, camera, camera_from_board, place, outwards, half_m);
  };
  std::vector<double> circles_m;
  const std::vector<TargetNode> nodes = target.nodes();
  for (const TargetNode& node : nodes) {
    for (int k = 0; k < kPlaces; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kPlaces;
      const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
      if (const auto found = offset(node.center_m + radius * out, out, 0.5 * radius))
        circles_m.push_back(*found);
    }
  }
  std::vector<double> tags_m;
  const std::vector<TargetTag> tags = target.tags();
  for (const TargetTag& tag : tags) {
    for (int k = 0; k < kPlaces; ++k) {
      // Four sides, six places on each, none near a corner; a tenth of the tag is less than the
      // border of any family.
      const double along = (k / 4 - 2.5) * 0.1 * target.tag_size_m;
      const Eigen::Vector2d out =
          Eigen::Rotation2Dd(0.5 * std::numbers::pi * (k % 4)) * Eigen::Vector2d::UnitX();
      const Eigen::Vector2d place =
          tag.center_m + 0.5 * target.tag_size_m * out + along * Eigen::Vector2d(-out.y(), out.x());
      if (const auto found = offset(place, out, 0.1 * target.tag_size_m)) tags_m.push_back(*found);
    }
  }
  constexpr std::size_t kHalf = kPlaces / 2;
  if (circles_m.size() < kHalf * nodes.size() || tags_m.size() < kHalf * tags.size() ||
      circles_m.empty() || tags_m.empty())
    return {};
  MeasuredRadius out;
  out.radius_m = radius + median(std::move(circles_m)) - median(std::move(tags_m));
  out.pixel_m = camera_from_board.translation.norm() / std::min(camera.fx, camera.fy);
  return out;
}

}  // namespace lvcalib
