// SPDX-License-Identifier: BSD-3-Clause
#include "design/board_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/rigid3.h"
#include "base/text.h"
#include "base/units.h"

namespace lvcalib {
namespace {

// Corners that frame the pattern; neighbours first, so that two of them tell the tags' size.
std::vector<Eigen::Vector2d> pattern_corners(const Target& target) {
  if (!target.has_tags()) return target.checkerboard_corners_m();
  std::vector<Eigen::Vector2d> out;
  for (const TargetTag& tag : target.tags()) {
    const auto corners = target.tag_corners_m(tag);
    out.insert(out.end(), corners.begin(), corners.end());
  }
  return out;
}

// The whole board and its whole print, with room for a board that is held by hand.
bool is_seen(const Target& target, const Camera& camera, const Rigid3& camera_from_board,
             double min_tag_px) {
  // Of the image's shorter side: some 5 cm at 2 m with a usual lens, by which hands miss a pose.
  constexpr double kRoom = 0.03;
  const double room_px = kRoom * std::min(camera.width_px, camera.height_px);
  const BoardOutline outline = target.outline();
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector2d at =
        outline.lower_left_m + Eigen::Vector2d(k % 2, k / 2).cwiseProduct(outline.size_m());
    const auto pixel = camera.project(camera_from_board * Eigen::Vector3d(at.x(), at.y(), 0.0));
    if (!pixel || !camera.in_image(*pixel + Eigen::Vector2d::Constant(room_px)) ||
        !camera.in_image(*pixel - Eigen::Vector2d::Constant(room_px)))
      return false;
  }
  const auto corners = pattern_corners(target);
  const std::size_t group = target.has_tags() ? 4 : 2;
  Eigen::Vector2d last = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto pixel =
        camera.project(camera_from_board * Eigen::Vector3d(corners[k].x(), corners[k].y(), 0.0));
    if (!pixel || !camera.in_image(*pixel)) return false;
    if (k % group != 0 && (*pixel - last).norm() < min_tag_px) return false;
    last = *pixel;
  }
  return true;
}

// Board at a point of the camera frame: turned to the line of sight, then tilted and rolled.
Rigid3 pose_at(const Target& target, const Eigen::Vector3d& center, const GridPose& pose) {
  const Eigen::Quaterniond to_sight =
      rotation_between(Eigen::Vector3d::UnitZ(), center.normalized());
  // Board x right, y up, z towards the camera.
  const Eigen::Quaterniond facing(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()));
  const Eigen::AngleAxisd about_x(kRadPerDeg * pose.tilt_x_deg, Eigen::Vector3d::UnitX());
  const Eigen::AngleAxisd about_y(kRadPerDeg * pose.tilt_y_deg, Eigen::Vector3d::UnitY());
  const Eigen::AngleAxisd roll(kRadPerDeg * pose.roll_deg, Eigen::Vector3d::UnitZ());
  Rigid3 out;
  out.rotation = (to_sight * facing * about_x * about_y * roll).normalized();
  const Eigen::Vector2d middle = target.outline().center_m();
  out.translation = center - out.rotation * Eigen::Vector3d(middle.x(), middle.y(), 0.0);
  return out;
}

// Tilts about one axis or the other; no tilt once.
std::vector<std::pair<double, double>> tilts_of(const BoardGridOptions& options) {
  std::vector<std::pair<double, double>> out;
  for (const double tilt : options.tilts_deg) {
    out.emplace_back(tilt, 0.0);
    if (tilt != 0.0) out.emplace_back(0.0, tilt);
  }
  return out;
}

}  // namespace

Status BoardGridOptions::check() const {
  const auto positive = [](double v) { return v > 0.0 && std::isfinite(v); };
  const auto turned = [](double v) { return std::abs(v) <= 80.0; };
  if (distances_m.empty() || tilts_deg.empty() || rolls_deg.empty() ||
      !std::all_of(distances_m.begin(), distances_m.end(), positive) ||
      !std::all_of(tilts_deg.begin(), tilts_deg.end(), turned) || cells < 1 || cells > 20) {
    return Error::usage(
        Message("grid of board poses: expected distances above zero, tilts up to 80 degrees, at "
                "least one of each, and 1 to 20 cells"));
  }
  return Done{};
}

Message GridPose::description() const {
  const auto number = [](const char* format, double v) { return formatted(format, std::abs(v)); };
  Message out = Message("at %1 m", number("%.1f", distance_m));
  const std::string aside = number("%.0f", right_deg);
  const std::string height = number("%.0f", down_deg);
  Message across, along;
  if (std::abs(right_deg) >= 0.5)
    across = right_deg > 0 ? Message("%1° right", aside) : Message("%1° left", aside);
  if (std::abs(down_deg) >= 0.5)
    along = down_deg > 0 ? Message("%1° below", height) : Message("%1° above", height);
  if (across.empty() && along.empty())
    out += Message(", in the middle of the image");
  else if (across.empty() || along.empty())
    out += Message(", %1 of the optical axis", across + along);
  else
    out += Message(", %1 and %2 of the optical axis", across, along);
  if (tilt_x_deg == 0.0 && tilt_y_deg == 0.0) out += Message(", facing the camera");
  if (tilt_x_deg != 0.0) {
    const std::string tilt = number("%.0f", tilt_x_deg);
    out += tilt_x_deg > 0 ? Message(", the top leaning towards the camera by %1°", tilt)
                          : Message(", the top leaning away by %1°", tilt);
  }
  if (tilt_y_deg != 0.0) {
    const std::string tilt = number("%.0f", tilt_y_deg);
    out += tilt_y_deg > 0 ? Message(", the right side turned away by %1°", tilt)
                          : Message(", the left side turned away by %1°", tilt);
  }
  if (roll_deg != 0.0) out += Message(", rolled by %1°", number("%.0f", roll_deg));
  return out;
}

std::vector<GridPose> board_grid(const Target& target, const Camera& camera,
                                 const BoardGridOptions& options) {
  std::vector<GridPose> out;
  for (int i = 0; i < options.cells; ++i) {
    for (int j = 0; j < options.cells; ++j) {
      const Eigen::Vector2d pixel((i + 0.5) / options.cells * camera.width_px - 0.5,
                                  (j + 0.5) / options.cells * camera.height_px - 0.5);
      const auto ray = camera.unproject(pixel);
      if (!ray) continue;
      for (const double distance : options.distances_m) {
        for (const auto& [tilt_x, tilt_y] : tilts_of(options)) {
          for (const double roll : options.rolls_deg) {
            GridPose pose{{},
                          distance,
                          tilt_x,
                          tilt_y,
                          roll,
                          std::atan2(ray->x(), ray->z()) / kRadPerDeg,
                          std::atan2(ray->y(), ray->z()) / kRadPerDeg};
            pose.camera_from_board = pose_at(target, distance * *ray, pose);
            if (is_seen(target, camera, pose.camera_from_board, options.min_tag_px))
              out.push_back(pose);
          }
        }
      }
    }
  }
  return out;
}

}  // namespace lvcalib
