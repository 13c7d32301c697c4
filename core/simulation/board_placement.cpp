// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/board_placement.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/units.h"
#include "simulation/seeds.h"

namespace lvcalib::simulation {
namespace {

constexpr int kTries = 20'000;

// Part of the image, on either side, where the board's centre may lie.
constexpr double kImageBorder = 0.15;

class Placer {
 public:
  Placer(const SimulationOptions& options, const Camera& camera, const Rigid3& camera_from_lidar,
         const ScanPattern& pattern, int scene, Random random)
      : options_(options.placement),
        camera_(camera),
        camera_from_lidar_(camera_from_lidar),
        lidar_from_camera_(camera_from_lidar.inverse()),
        pattern_(pattern),
        scene_(scene),
        random_(random),
        points_(outline_points(options.target, 9)),
        center_(options.target.outline().center_m()) {
    // The same start for all scenes of a seed, so that the golden angle spreads them.
    Random shared = random_for(options.seed, -1, Purpose::kPlacement);
    first_tilt_direction_ = shared.uniform(0.0, 2.0 * std::numbers::pi);
  }

  Result<Rigid3> place() {
    for (int attempt = 0; attempt < kTries; ++attempt) {
      const std::optional<Eigen::Vector3d> position = random_position();
      if (!position) continue;
      const Rigid3 lidar_from_board = oriented_at(*position);
      if (fits(lidar_from_board)) return lidar_from_board;
    }
    return Error::usage(
        options_.partial ? Message("no place was found where the board is in the image but partly "
                                   "outside the LiDAR's field of view")
                         : Message("no place was found where the whole board is in the image and "
                                   "in the LiDAR's field of view"),
        "board placement", Message("change the distances, the board's size or the image size"));
  }

 private:
  // A point on a random camera ray at a random distance from the LiDAR.
  std::optional<Eigen::Vector3d> random_position() {
    const double border = options_.partial ? 0.05 : kImageBorder;
    // One draw a statement: in which order a compiler evaluates arguments is its own choice.
    const double down = random_.uniform(border, 1.0 - border);
    const double across = random_.uniform(border, 1.0 - border);
    const Eigen::Vector2d pixel(camera_.width_px * across, camera_.height_px * down);
    const double distance = random_.uniform(options_.min_distance_m, options_.max_distance_m);
    const auto ray = camera_.unproject(pixel);
    if (!ray) return std::nullopt;
    const Eigen::Vector3d& origin = lidar_from_camera_.translation;
    const Eigen::Vector3d direction = lidar_from_camera_.rotation * *ray;
    // |origin + s·direction| = distance.
    const double half = origin.dot(direction);
    const double root = half * half - origin.squaredNorm() + distance * distance;
    if (root < 0.0) return std::nullopt;
    return origin + (std::sqrt(root) - half) * direction;
  }

  // The board's centre at `position`, facing the LiDAR, then tilted and rolled.
  Rigid3 oriented_at(const Eigen::Vector3d& position) {
    // Walls are upright, so a board on one looks along the horizontal.
    const double height = options_.flush_on_wall ? 0.0 : position.z();
    const Eigen::Vector3d z = -Eigen::Vector3d(position.x(), position.y(), height).normalized();
    const Eigen::Vector3d x = Eigen::Vector3d::UnitZ().cross(z).normalized();
    Eigen::Matrix3d facing;
    facing << x, z.cross(x), z;
    const double share = scene_ == 0 ? random_.uniform(0.0, 0.4) : random_.uniform(0.5, 1.0);
    const double tilt = share * options_.max_tilt_deg * kRadPerDeg;
    double direction = first_tilt_direction_ + kGoldenAngleRad * scene_ + random_.normal(0.0, 0.2);
    if (options_.flush_on_wall) direction = std::numbers::pi * (0.5 + scene_ % 2);
    const Eigen::Vector3d axis(std::cos(direction), std::sin(direction), 0.0);
    const Eigen::Vector3d roll(0.0, 0.0,
                               options_.max_roll_deg * kRadPerDeg * random_.uniform(-1.0, 1.0));
    const Eigen::Quaterniond rotation =
        Eigen::Quaterniond(facing) * so3_exp(tilt * axis) * so3_exp(roll);
    const Eigen::Vector3d center(center_.x(), center_.y(), 0.0);
    return {rotation.normalized(), position - rotation * center};
  }

  [[nodiscard]] bool fits(const Rigid3& lidar_from_board) const {
    const Rigid3 camera_from_board = camera_from_lidar_ * lidar_from_board;
    const double border = 0.02 * camera_.height_px;
    std::size_t outside = 0;
    for (const Eigen::Vector3d& point : points_) {
      const auto pixel = camera_.project(camera_from_board * point);
      if (!pixel || pixel->x() < border || pixel->y() < border ||
          pixel->x() > camera_.width_px - border || pixel->y() > camera_.height_px - border) {
        return false;
      }
      if (!pattern_.in_field(lidar_from_board * point)) ++outside;
    }
    const double share = static_cast<double>(outside) / static_cast<double>(points_.size());
    return options_.partial ? share >= 0.1 && share <= 0.5 : outside == 0;
  }

  const PlacementOptions& options_;
  const Camera& camera_;
  const Rigid3& camera_from_lidar_;
  Rigid3 lidar_from_camera_;
  const ScanPattern& pattern_;
  int scene_;
  Random random_;
  std::vector<Eigen::Vector3d> points_;
  Eigen::Vector2d center_;
  double first_tilt_direction_ = 0.0;
};

}  // namespace

Result<Rigid3> place_board(const SimulationOptions& options, const Camera& camera,
                           const Rigid3& camera_from_lidar, const ScanPattern& pattern, int scene,
                           Random random) {
  return Placer(options, camera, camera_from_lidar, pattern, scene, random).place();
}

std::vector<Eigen::Vector3d> outline_points(const Target& target, int per_side) {
  const BoardOutline outline = target.outline();
  const Eigen::Vector2d size = outline.size_m();
  std::vector<Eigen::Vector3d> points;
  for (int j = 0; j < per_side; ++j) {
    for (int i = 0; i < per_side; ++i) {
      const double last = per_side - 1;
      points.emplace_back(outline.lower_left_m.x() + size.x() * i / last,
                          outline.lower_left_m.y() + size.y() * j / last, 0.0);
    }
  }
  return points;
}

}  // namespace lvcalib::simulation
