// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/message.h"
#include "base/rigid3.h"
#include "cloud/cloud.h"
#include "detection/board_view.h"
#include "target/target.h"

namespace lvcalib {

/// What the user left out of a scene by hand, and what is used though the program refuses it.
struct SceneEdits {
  /// Left out of the points about the board: LiDAR frame, exactly as the cloud has them.
  std::vector<Eigen::Vector3f> points_m;
  /// Polygons on the board (board frame): returns whose ray meets one are left out.
  std::vector<std::vector<Eigen::Vector2d>> patches_m;
  /// Left out by id. Without a circle the returns about its edge are left out as well.
  std::vector<int> tags;
  std::vector<int> circles;
  /// Used by id, though they miss the board's pose by more than the gate.
  std::vector<int> kept_tags;
  std::vector<int> kept_circles;
  /// Used, though something seems to cover the board there.
  std::vector<BoardOutline> kept_patches;

  [[nodiscard]] bool empty() const { return *this == SceneEdits{}; }
  bool operator==(const SceneEdits&) const = default;
};

/// Why something is left out that the user does not want.
inline const Message kLeftOutByUser = Message("left out by the user");

bool contains_id(const std::vector<int>& ids, int id);

/// Indices (ascending) of the points that the edits leave out, with the board there.
std::vector<std::uint32_t> left_out_points(const Cloud& cloud, const SceneEdits& edits,
                                           const Target& target, const Rigid3& lidar_from_board);

/// Takes those points out of a cloud and returns them.
Cloud take_out(Cloud& cloud, const SceneEdits& edits, const Target& target,
               const Rigid3& lidar_from_board);

/// Takes the corners of the tags out that the edits leave out, and returns them.
std::vector<CornerObservation> take_out(BoardView& view, const SceneEdits& edits);

/// What of the edits a refinement depends on, as text; empty if nothing.
std::string refinement_key(const SceneEdits& edits);

/// The convex patch of the board that holds the places where the rays of these points meet it, and
/// a millimetre about them.
std::vector<Eigen::Vector2d> patch_about(const std::vector<Eigen::Vector3f>& points_m,
                                         const Rigid3& lidar_from_board);

/// The part of the ring about a circle's edge between two polar angles (board frame, from x to y),
/// as a patch.
std::vector<Eigen::Vector2d> ring_patch(const Target& target, int circle, double from_rad,
                                        double to_rad);

}  // namespace lvcalib
