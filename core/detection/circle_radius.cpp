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

constexpr int kSteps = 64;   // Across an edge: some for each pixel of the nearest boards.
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

// An edge across a way that leads out of black print.
struct EdgeSeen {
  double offset_m = 0.0;  // From the place asked about to where the grey level is in the middle.
  double sigma_m = 0.0;   // Of the blur: half of the way from the level's 16 % to its 84 %.
};

// Where levels in equal steps first reach one, counted in steps; the last of them does.
double first_at(const std::vector<double>& levels, double wanted) {
  std::size_t k = 0;
  while (levels[k] < wanted) ++k;
  if (k == 0) return 0.0;
  const double before = levels[k - 1];
  return static_cast<double>(k - 1) + (wanted - before) / (levels[k] - before);
}

// The edge within `half_m` to either side of a place, between the darkest level before the
// brightest one and that. Nothing where the image does not show it.
std::optional<EdgeSeen> seen_edge(const GrayImage& image, const Camera& camera,
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
  const double contrast = *brightest - dark;
  // Eight bits hold an edge to some hundredths of its contrast from here on.
  constexpr double kFewestLevels = 20.0;
  if (contrast < kFewestLevels || levels.front() > dark + 0.5 * contrast) return std::nullopt;
  const double step_m = 2.0 * half_m / kSteps;
  const auto reached = [&](double share) { return first_at(levels, dark + share * contrast); };
  return EdgeSeen{reached(0.5) * step_m - half_m, 0.5 * (reached(0.84) - reached(0.16)) * step_m};
}

}  // namespace

MeasuredRadius measure_circle_radius(const GrayImage& image, const Target& target,
                                     const Camera& camera, const Rigid3& camera_from_board) {
  if (!target.has_circles()) return {};
  const double radius = target.circle_radius_m;
  const auto offset = [&](const Eigen::Vector2d& place, const Eigen::Vector2d& outwards,
                          double half_m) {
    return seen_edge(image, camera, camera_from_board, place, outwards, half_m);
  };
  std::vector<double> circles_m;
  const std::vector<TargetNode> nodes = target.nodes();
  for (const TargetNode& node : nodes) {
    for (int k = 0; k < kPlaces; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kPlaces;
      const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
      if (const auto found = offset(node.center_m + radius * out, out, 0.5 * radius))
        circles_m.push_back(found->offset_m);
    }
  }
  std::vector<double> tags_m;
  std::vector<double> sigmas_m;
  // Less than the border of any family.
  const double tag_half_m = 0.1 * target.tag_size_m;
  const std::vector<TargetTag> tags = target.tags();
  for (const TargetTag& tag : tags) {
    for (int k = 0; k < kPlaces; ++k) {
      // Four sides, six places on each, none near a corner.
      const double along = (k / 4 - 2.5) * 0.1 * target.tag_size_m;
      const Eigen::Vector2d out =
          Eigen::Rotation2Dd(0.5 * std::numbers::pi * (k % 4)) * Eigen::Vector2d::UnitX();
      const Eigen::Vector2d place =
          tag.center_m + 0.5 * target.tag_size_m * out + along * Eigen::Vector2d(-out.y(), out.x());
      const auto found = offset(place, out, tag_half_m);
      if (!found) continue;
      tags_m.push_back(found->offset_m);
      sigmas_m.push_back(found->sigma_m);
    }
  }
  constexpr std::size_t kHalf = kPlaces / 2;
  if (circles_m.size() < kHalf * nodes.size() || tags_m.size() < kHalf * tags.size() ||
      circles_m.empty() || tags_m.empty())
    return {};
  // Wider blur does not leave the border its black: what edges then show is not their place.
  const double sigma_m = median(std::move(sigmas_m));
  if (3.0 * sigma_m > tag_half_m) return {};
  MeasuredRadius out;
  // Blur σ moves a disc's edge inwards by σ²/2r, to second order; a straight one stays.
  out.radius_m = radius + median(std::move(circles_m)) - median(std::move(tags_m)) +
                 sigma_m * sigma_m / (2.0 * radius);
  out.pixel_m = camera_from_board.translation.norm() / std::min(camera.fx, camera.fy);
  return out;
}

}  // namespace lvcalib
