// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/room.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lvcalib::simulation {

RayCaster::RayCaster(const Room& room, const Eigen::Vector3d& origin_m) : room_(&room) {
  const std::size_t count = std::min(room.surfaces.size(), kMaxSurfaces);
  for (std::size_t i = 0; i < count; ++i) {
    const Surface& surface = room.surfaces[i];
    const Eigen::Vector3d to_center = surface.center_m - origin_m;
    Face face;
    face.normal = surface.normal();
    face.u = surface.u;
    face.v = surface.v;
    face.distance = face.normal.dot(to_center);
    face.offset_u = face.u.dot(to_center);
    face.offset_v = face.v.dot(to_center);
    face.half_u = surface.half_u_m;
    face.half_v = surface.half_v_m;
    const double far = to_center.norm();
    face.always = far <= surface.radius_m();
    face.axis = face.always ? Eigen::Vector3d(Eigen::Vector3d::UnitX()) : to_center / far;
    face.cone_rad = face.always ? std::numbers::pi : std::asin(surface.radius_m() / far);
    faces_.push_back(face);
    if (surface.board != nullptr) board_center_m_ = surface.board->outline().center_m();
  }
}

std::span<const std::uint8_t> RayCaster::candidates(const Eigen::Vector3d& direction,
                                                    double margin_rad, Candidates& storage) const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const Face& face = faces_[i];
    const double cone = face.cone_rad + margin_rad;
    const bool seen =
        face.always || cone >= std::numbers::pi || face.axis.dot(direction) >= std::cos(cone);
    if (seen) storage[count++] = static_cast<std::uint8_t>(i);
  }
  return {storage.data(), count};
}

Hit RayCaster::cast(const Eigen::Vector3d& direction,
                    std::span<const std::uint8_t> candidates) const {
  Hit hit;
  hit.range_m = std::numeric_limits<double>::max();
  for (const std::uint8_t index : candidates) {
    const Face& face = faces_[index];
    const double slope = face.normal.dot(direction);
    // Same sign: the plane lies ahead. Written so that a ray without direction (NaN) hits nothing.
    if (!(slope * face.distance > 0.0)) continue;
    const double range = face.distance / slope;
    if (range >= hit.range_m) continue;
    const double u = face.u.dot(direction) * range - face.offset_u;
    if (std::abs(u) > face.half_u) continue;
    const double v = face.v.dot(direction) * range - face.offset_v;
    if (std::abs(v) > face.half_v) continue;
    hit = {index, range, u, v, std::abs(slope)};
  }
  return hit;
}

Hit RayCaster::meet_plane(const Eigen::Vector3d& direction, int surface) const {
  const Face& face = faces_[static_cast<std::size_t>(surface)];
  const double slope = face.normal.dot(direction);
  if (!(slope * face.distance > 0.0)) return {};
  const double range = face.distance / slope;
  return {surface, range, face.u.dot(direction) * range - face.offset_u,
          face.v.dot(direction) * range - face.offset_v, std::abs(slope)};
}

double RayCaster::reflectivity(const Hit& hit) const {
  const Surface& surface = room_->surfaces[static_cast<std::size_t>(hit.surface)];
  if (surface.board == nullptr) return surface.texture.at(hit.u_m, hit.v_m);
  const Eigen::Vector2d point = on_board(hit);
  return surface.board->reflectivity(point.x(), point.y());
}

}  // namespace lvcalib::simulation
