// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "simulation/printed_board.h"
#include "simulation/texture.h"

namespace lvcalib::simulation {

/// A flat rectangle of the room, seen from both sides. All vectors in the LiDAR frame.
struct Surface {
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d u = Eigen::Vector3d::UnitX();  ///< Unit, along the first side.
  Eigen::Vector3d v = Eigen::Vector3d::UnitY();  ///< Unit, along the second side, ⟂ u.
  double half_u_m = 1.0;
  double half_v_m = 1.0;
  Texture texture;
  const PrintedBoard* board = nullptr;  ///< Set for the board, whose print it then carries.

  [[nodiscard]] Eigen::Vector3d normal() const { return u.cross(v); }
  [[nodiscard]] double radius_m() const { return std::hypot(half_u_m, half_v_m); }
};

/// All surfaces of one scene. The room itself is closed: every ray hits something.
struct Room {
  std::vector<Surface> surfaces;
  Eigen::Vector3d light = Eigen::Vector3d::UnitZ();  ///< Unit, towards the lamp.
};

/// Where a ray meets a surface: u, v from the surface's centre.
struct Hit {
  int surface = -1;  ///< −1: nothing.
  double range_m = 0.0;
  double u_m = 0.0;
  double v_m = 0.0;
  double cos_incidence = 0.0;
};

/// Casts rays from one origin. Surfaces are first sorted out by their bounding cones: a bundle of
/// neighbouring rays asks once for the candidates and then tests these only.
class RayCaster {
 public:
  static constexpr std::size_t kMaxSurfaces = 64;
  using Candidates = std::array<std::uint8_t, kMaxSurfaces>;

  RayCaster(const Room& room, const Eigen::Vector3d& origin_m);

  /// Surfaces that a ray within `margin_rad` of the unit direction may meet,
  /// from anywhere within `start_m` of the origin.
  std::span<const std::uint8_t> candidates(const Eigen::Vector3d& direction, double margin_rad,
                                           Candidates& storage, double start_m = 0.0) const;

  /// The nearest hit along a unit direction among the candidates. The ray starts at the origin, or
  /// at `start_m` from it.
  [[nodiscard]] Hit cast(const Eigen::Vector3d& direction, std::span<const std::uint8_t> candidates,
                         const Eigen::Vector3d* start_m = nullptr) const;

  /// Where the ray meets the surface, whether within the rectangle or not.
  [[nodiscard]] Hit meet_plane(const Eigen::Vector3d& direction, int surface) const;

  [[nodiscard]] const Room& room() const { return *room_; }
  /// Whether a surface is one of the room's own faces, which only ever lie behind the others.
  [[nodiscard]] bool encloses_origin(int surface) const {
    return faces_[static_cast<std::size_t>(surface)].always;
  }
  /// With black edges of the board's print further out by `edge_shift_m`.
  [[nodiscard]] double reflectivity(const Hit& hit, double edge_shift_m = 0.0) const;
  [[nodiscard]] bool is_board(const Hit& hit) const {
    return room_->surfaces[static_cast<std::size_t>(hit.surface)].board != nullptr;
  }
  /// Board coordinates of a hit on the board.
  [[nodiscard]] Eigen::Vector2d on_board(const Hit& hit) const {
    return board_center_m_ + Eigen::Vector2d(hit.u_m, hit.v_m);
  }

 private:
  struct Face {
    Eigen::Vector3d normal, u, v;
    double distance;            // normal · (center − origin)
    double offset_u, offset_v;  // of the centre, seen from the origin
    double half_u, half_v;
    Eigen::Vector3d axis;  // of the bounding cone
    double cone_rad;
    double far, radius;        // of the bounding sphere
    const PrintedBoard* bent;  // A board that is not flat.
    bool always;               // the origin is inside the bounding sphere
  };
  [[nodiscard]] Hit cast_any(const Eigen::Vector3d& direction,
                             std::span<const std::uint8_t> candidates,
                             const Eigen::Vector3d* start_m) const;
  [[nodiscard]] Hit meet(const Face& face, int surface, const Eigen::Vector3d& direction,
                         const Eigen::Vector3d* start_m) const;
  void follow_shape(const Face& face, const Eigen::Vector3d& direction, Hit& hit) const;

  const Room* room_;
  std::vector<Face> faces_;
  bool has_bent_face_ = false;
  Eigen::Vector2d board_center_m_ = Eigen::Vector2d::Zero();
};

}  // namespace lvcalib::simulation
