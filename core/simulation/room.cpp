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
    face.far = far;
    face.radius = surface.radius_m();
    const bool bent = surface.board != nullptr && !surface.board->shape().is_flat();
    face.bent = bent ? surface.board : nullptr;
    has_bent_face_ = has_bent_face_ || bent;
    face.always = far <= surface.radius_m();
    face.axis = face.always ? Eigen::Vector3d(Eigen::Vector3d::UnitX()) : to_center / far;
    face.cone_rad = face.always ? std::numbers::pi : std::asin(surface.radius_m() / far);
    faces_.push_back(face);
    if (surface.board != nullptr) board_center_m_ = surface.board->outline().center_m();
  }
}

std::span<const std::uint8_t> RayCaster::candidates(const Eigen::Vector3d& direction,
                                                    double margin_rad, Candidates& storage,
                                                    double start_m) const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const Face& face = faces_[i];
    double cone = face.cone_rad + margin_rad;
    if (start_m > 0.0) {
      // From another start the nearest point of the sphere is seen elsewhere by this much.
      const double near = face.far - face.radius;
      cone += near > start_m ? std::asin(start_m / near) : std::numbers::pi;
    }
    const bool seen =
        face.always || cone >= std::numbers::pi || face.axis.dot(direction) >= std::cos(cone);
    if (seen) storage[count++] = static_cast<std::uint8_t>(i);
  }
  return {storage.data(), count};
}

// Where a ray meets the face or its continuation; nothing if it lies behind or along it.
Hit RayCaster::meet(const Face& face, int surface, const Eigen::Vector3d& direction,
                    const Eigen::Vector3d* start_m) const {
  const double slope = face.normal.dot(direction);
  const double distance =
      start_m == nullptr ? face.distance : face.distance - face.normal.dot(*start_m);
  if (!(slope * distance > 0.0)) return {};
  Hit hit{surface, distance / slope, 0.0, 0.0, std::abs(slope)};
  hit.u_m = face.u.dot(direction) * hit.range_m - face.offset_u;
  hit.v_m = face.v.dot(direction) * hit.range_m - face.offset_v;
  if (start_m != nullptr) {
    hit.u_m += face.u.dot(*start_m);
    hit.v_m += face.v.dot(*start_m);
  }
  if (face.bent != nullptr) follow_shape(face, direction, hit);
  return hit;
}

// Moves a hit on a bent board's plane to its face. Boards are all but flat, so that the height
// where the ray meets the plane is nearly the one where it meets the face.
void RayCaster::follow_shape(const Face& face, const Eigen::Vector3d& direction, Hit& hit) const {
  constexpr double kEnough = 1e-7;
  const BoardDisturbance& shape = face.bent->shape();
  const double slope = face.normal.dot(direction);
  const double across_u = face.u.dot(direction);
  const double across_v = face.v.dot(direction);
  double height = 0.0;
  for (int i = 0; i < 10; ++i) {
    const double next =
        shape.height_m(board_center_m_.x() + hit.u_m, board_center_m_.y() + hit.v_m);
    const double step = (next - height) / slope;
    height = next;
    hit.range_m += step;
    hit.u_m += across_u * step;
    hit.v_m += across_v * step;
    if (std::abs(step) < kEnough) break;
  }
  const Eigen::Vector2d tilt =
      shape.slope(board_center_m_.x() + hit.u_m, board_center_m_.y() + hit.v_m);
  const Eigen::Vector3d normal = (face.normal - tilt.x() * face.u - tilt.y() * face.v).normalized();
  hit.cos_incidence = std::abs(normal.dot(direction));
}

Hit RayCaster::cast(const Eigen::Vector3d& direction, std::span<const std::uint8_t> candidates,
                    const Eigen::Vector3d* start_m) const {
  if (start_m != nullptr || has_bent_face_) return cast_any(direction, candidates, start_m);
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

// As cast(), for starts beside the origin and faces that are not flat.
Hit RayCaster::cast_any(const Eigen::Vector3d& direction, std::span<const std::uint8_t> candidates,
                        const Eigen::Vector3d* start_m) const {
  Hit nearest;
  nearest.range_m = std::numeric_limits<double>::max();
  for (const std::uint8_t index : candidates) {
    const Face& face = faces_[index];
    const Hit hit = meet(face, index, direction, start_m);
    if (hit.surface < 0 || hit.range_m >= nearest.range_m) continue;
    if (std::abs(hit.u_m) > face.half_u || std::abs(hit.v_m) > face.half_v) continue;
    nearest = hit;
  }
  return nearest;
}

Hit RayCaster::meet_plane(const Eigen::Vector3d& direction, int surface) const {
  return meet(faces_[static_cast<std::size_t>(surface)], surface, direction, nullptr);
}

double RayCaster::reflectivity(const Hit& hit, double edge_shift_m) const {
  const Surface& surface = room_->surfaces[static_cast<std::size_t>(hit.surface)];
  if (surface.board == nullptr) return surface.texture.at(hit.u_m, hit.v_m);
  const Eigen::Vector2d point = on_board(hit);
  return surface.board->reflectivity(point.x(), point.y(), edge_shift_m);
}

}  // namespace lvcalib::simulation
