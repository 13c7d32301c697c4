// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/standing_board.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/statistics.h"
#include "cloud/plane.h"
#include "refinement/board_refinement.h"

namespace lvcalib {
namespace {

// What localization and a single view leave open of a board's pose, at most.
constexpr double kNear_m = 0.05;
constexpr double kNear_rad = 0.1;
constexpr double kBand_m = 0.15;  // Beside the outline, where a wall would go on.

// Where points about a board lie, in its frame.
struct Occupancy {
  double inside_per_m2 = 0.0;
  double beside_per_m2 = 0.0;
  int quarters = 0;  // Of the outline, with points.
};

Occupancy occupancy(const Cloud& about, const BoardOutline& outline, const Rigid3& board,
                    double tolerance_m) {
  const Eigen::Vector2d half = 0.5 * outline.size_m();
  const Eigen::Vector2d wide = half.array() + kBand_m;
  std::array<bool, 4> seen{};
  double inside = 0.0;
  double beside = 0.0;
  for (const Eigen::Vector3f& point : about.points_m) {
    const Eigen::Vector3d p = board.inverse() * point.cast<double>();
    if (std::abs(p.z()) > tolerance_m) continue;
    const Eigen::Vector2d d = p.head<2>() - outline.center_m();
    if ((d.cwiseAbs().array() <= half.array()).all()) {
      inside += 1.0;
      seen[(d.x() > 0.0 ? 1U : 0U) + (d.y() > 0.0 ? 2U : 0U)] = true;
      continue;
    }
    // A margin for what is left open of the board's place.
    if (((d.cwiseAbs() - half).array() > kNear_m).any()) beside += 1.0;
  }
  const double area = 4.0 * half.prod();
  const Eigen::Vector2d margin = half.array() + kNear_m;
  return {inside / area, beside / (4.0 * (wide.prod() - margin.prod())),
          static_cast<int>(std::count(seen.begin(), seen.end(), true))};
}

}  // namespace

std::optional<BoardSearchResult> find_standing_board(const Cloud& cloud, const Target& target,
                                                     const Rigid3& lidar_from_board) {
  constexpr std::size_t kFewest = 40;  // Returns: twenty for half of the board.
  constexpr double kOnPlane = 0.8;     // Of what is within kNear_m of the plane.
  constexpr double kFainter = 0.5;     // Beside the board, against on it.
  const BoardOutline outline = target.outline();
  const Eigen::Vector2d reach = 0.5 * outline.size_m().array() + kBand_m;
  BoardSearchResult out;
  Cloud& about = out.patch_points.emplace_back();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = lidar_from_board.inverse() * cloud.points_m[i].cast<double>();
    const Eigen::Vector2d d = p.head<2>() - outline.center_m();
    if (std::abs(p.z()) < 2.0 * kNear_m && (d.cwiseAbs().array() < reach.array()).all())
      append_point(about, cloud, i);
  }
  const auto plane = fit_board_plane(about, target, lidar_from_board);
  if (!plane || plane->board_points < kFewest) return std::nullopt;
  const Rigid3& board = plane->lidar_from_board;
  const Eigen::Vector3d middle(outline.center_m().x(), outline.center_m().y(), 0.0);
  const double height_m = (lidar_from_board.inverse() * (board * middle)).z();
  if (std::abs(height_m) > kNear_m || rotation_distance_rad(board, lidar_from_board) > kNear_rad)
    return std::nullopt;
  const auto& sigma = plane->plane.group_sigma_m;
  const double noise_m = *std::max_element(sigma.begin(), sigma.end());
  if (2.0 * noise_m > kNear_m) return std::nullopt;  // Noisier than any LiDAR: not flat.
  const Occupancy flat = occupancy(about, outline, board, 4.0 * noise_m);
  const Occupancy all = occupancy(about, outline, board, kNear_m);
  if (flat.quarters < 2 || flat.inside_per_m2 < kOnPlane * all.inside_per_m2 ||
      flat.beside_per_m2 > kFainter * flat.inside_per_m2)
    return std::nullopt;
  BoardCandidate candidate;
  candidate.lidar_from_board.transform = board;
  candidate.lidar_from_board.covariance.diagonal().head<3>().setConstant(kNear_m * kNear_m);
  candidate.lidar_from_board.covariance.diagonal().tail<3>().setConstant(kNear_rad * kNear_rad);
  // What it may miss the others' extrinsic by and still counts (see decide_scenes()).
  candidate.gain = 0.5 * chi_square_gate(6, 1e-4);
  out.candidates.push_back(candidate);
  return out;
}

}  // namespace lvcalib
