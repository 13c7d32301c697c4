// SPDX-License-Identifier: BSD-3-Clause
// From the voxels of half a million points to the flat patches in 57 ms. PCL's RegionGrowing with
// its normals takes 325 ms for the same voxels (pcl_benchmark).
#include "localization/planar_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <unordered_set>

#include <Eigen/Geometry>

#include "base/random.h"
#include "base/statistics.h"
#include "base/symmetric.h"

namespace lvcalib {
namespace {

struct LocalPlane {
  Eigen::Vector3d normal;
  Eigen::Vector3d center;
  std::size_t inliers = 0;
};

constexpr std::size_t kMinNeighbours = 10;  // Fewer cannot tell a plane from chance.
constexpr int kTriplets = 24;               // 99 % to hit three of a 60 % majority.
// Share of a neighbourhood that must be flat: a board on a stand has other things beside it.
constexpr double kMinFlatShare = 0.4;
// Seen flatter than this (cosine of incidence) a plane gives no usable board.
constexpr double kMinCosIncidence = 0.12;

std::optional<LocalPlane> least_squares_plane(const VoxelCloud& cloud,
                                              const std::vector<std::uint32_t>& ids) {
  if (ids.size() < 3) return std::nullopt;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto i : ids) mean += cloud.voxels()[i].mean_m.cast<double>();
  mean /= static_cast<double>(ids.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto i : ids) {
    const Eigen::Vector3d d = cloud.voxels()[i].mean_m.cast<double>() - mean;
    scatter += d * d.transpose();
  }
  const auto axes = axes_of(scatter);
  // All on one line: no plane.
  if (axes.values(1) < 1e-3 * axes.values(2)) return std::nullopt;
  Eigen::Vector3d normal = axes.vectors.col(0);
  if (normal.dot(mean) > 0) normal = -normal;
  return LocalPlane{normal, mean, ids.size()};
}

std::vector<std::uint32_t> within(const VoxelCloud& cloud, const std::vector<std::uint32_t>& ids,
                                  const LocalPlane& plane, double tolerance) {
  std::vector<std::uint32_t> out;
  out.reserve(ids.size());
  for (const auto i : ids) {
    const Eigen::Vector3d d = cloud.voxels()[i].mean_m.cast<double>() - plane.center;
    if (std::abs(plane.normal.dot(d)) <= tolerance) out.push_back(i);
  }
  return out;
}

// Plane of the majority of a neighbourhood, by random triplets and one least-squares step.
std::optional<LocalPlane> majority_plane(const VoxelCloud& cloud,
                                         const std::vector<std::uint32_t>& ids, double tolerance,
                                         std::uint64_t seed) {
  if (ids.size() < kMinNeighbours) return std::nullopt;
  Random random(seed);
  LocalPlane best;
  const auto count = static_cast<std::uint32_t>(ids.size());
  const std::size_t stride = std::max<std::size_t>(1, ids.size() / 200);  // Scoring needs no more.
  for (int t = 0; t < kTriplets; ++t) {
    const auto pick = [&] {
      return cloud.voxels()[ids[random.below(count)]].mean_m.cast<double>().eval();
    };
    const Eigen::Vector3d a = pick();
    const Eigen::Vector3d b = pick();
    const Eigen::Vector3d c = pick();
    const Eigen::Vector3d n = (b - a).cross(c - a);
    // Slim triangles give wild normals: height must exceed the tolerance clearly.
    const double longest = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
    if (n.norm() < 3.0 * tolerance * longest) continue;
    LocalPlane plane{n.normalized(), a, 0};
    for (std::size_t k = 0; k < ids.size(); k += stride) {
      const Eigen::Vector3d d = cloud.voxels()[ids[k]].mean_m.cast<double>() - a;
      if (std::abs(plane.normal.dot(d)) <= tolerance) ++plane.inliers;
    }
    if (plane.inliers > best.inliers) best = plane;
  }
  if (static_cast<double>(best.inliers * stride) <
      kMinFlatShare * static_cast<double>(ids.size())) {
    return std::nullopt;
  }
  return least_squares_plane(cloud, within(cloud, ids, best, tolerance));
}

// Cells of a plane about a seed, and which of them are connected to it.
class CellGrid {
 public:
  CellGrid(const Eigen::Vector2d& seed, double cell, double radius)
      : seed_(seed),
        cell_(cell),
        half_(static_cast<int>(std::ceil(radius / cell)) + 2),
        side_(2 * half_ + 1),
        occupied_(static_cast<std::size_t>(side_ * side_), 0) {}

  [[nodiscard]] int cell_of(const Eigen::Vector2d& q) const {
    // The outermost ring stays empty, so that neighbours always exist.
    const auto index = [&](double v) {
      return std::clamp(static_cast<int>(std::floor(v / cell_)) + half_, 1, side_ - 2);
    };
    return index(q.y() - seed_.y()) * side_ + index(q.x() - seed_.x());
  }
  void occupy(int cell) { occupied_[static_cast<std::size_t>(cell)] = 1; }

  // Cells connected to the seed over eight neighbours. With `open`, connections narrower than
  // three cells do not count: where the board's plane cuts floor or walls they carry a thin strip
  // of points that would tie the board to the room.
  [[nodiscard]] std::vector<char> reach(bool open) const {
    const std::vector<char> core = open ? eroded() : occupied_;
    const int start = nearest(core);
    std::vector<char> reached(occupied_.size(), 0);
    if (start < 0) return open ? reach(false) : reached;
    std::vector<int> front{start};
    reached[static_cast<std::size_t>(start)] = 1;
    while (!front.empty()) {
      const int at = front.back();
      front.pop_back();
      for_neighbours(at, [&](int next) {
        const auto n = static_cast<std::size_t>(next);
        if (core[n] != 0 && reached[n] == 0) {
          reached[n] = 1;
          front.push_back(next);
        }
      });
    }
    return open ? dilated(reached) : reached;
  }

 private:
  template <class F>
  void for_neighbours(int at, F&& visit) const {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int next = at + dy * side_ + dx;
        if (next >= 0 && next < side_ * side_) visit(next);
      }
    }
  }
  [[nodiscard]] std::vector<char> eroded() const {
    std::vector<char> out(occupied_.size(), 0);
    for (int at = 0; at < side_ * side_; ++at) {
      int count = 0;
      for_neighbours(at, [&](int next) { count += occupied_[static_cast<std::size_t>(next)]; });
      // One hole is allowed: noise and dark print drop returns.
      out[static_cast<std::size_t>(at)] = count >= 8 ? 1 : 0;
    }
    return out;
  }
  [[nodiscard]] std::vector<char> dilated(const std::vector<char>& cells) const {
    std::vector<char> out = cells;
    for (int at = 0; at < side_ * side_; ++at) {
      if (cells[static_cast<std::size_t>(at)] == 0) continue;
      for_neighbours(at, [&](int next) {
        if (occupied_[static_cast<std::size_t>(next)] != 0) out[static_cast<std::size_t>(next)] = 1;
      });
    }
    return out;
  }
  // The marked cell nearest to the seed, within three cells; −1 if there is none.
  [[nodiscard]] int nearest(const std::vector<char>& cells) const {
    int best = -1;
    int best_distance = 1000;
    for (int dy = -3; dy <= 3; ++dy) {
      for (int dx = -3; dx <= 3; ++dx) {
        const int y = half_ + dy;
        const int x = half_ + dx;
        if (y < 0 || x < 0 || y >= side_ || x >= side_) continue;
        const int distance = dx * dx + dy * dy;
        if (cells[static_cast<std::size_t>(y * side_ + x)] != 0 && distance < best_distance) {
          best = y * side_ + x;
          best_distance = distance;
        }
      }
    }
    return best;
  }

  Eigen::Vector2d seed_;
  double cell_;
  int half_;
  int side_;
  std::vector<char> occupied_;
};

// The part of `ids` connected to the seed of an empty grid on the patch.
std::vector<std::uint32_t> connected_part(const VoxelCloud& cloud,
                                          const std::vector<std::uint32_t>& ids,
                                          const PlanarPatch& frame, CellGrid grid,
                                          bool cut_strips) {
  std::vector<int> cells(ids.size());
  for (std::size_t k = 0; k < ids.size(); ++k) {
    cells[k] = grid.cell_of(frame.to_plane(cloud.voxels()[ids[k]].mean_m.cast<double>()));
    grid.occupy(cells[k]);
  }
  const std::vector<char> reached = grid.reach(cut_strips);
  std::vector<std::uint32_t> out;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (reached[static_cast<std::size_t>(cells[k])] != 0) out.push_back(ids[k]);
  }
  return out;
}

// Sides of the smallest rectangle around the points, each side trimmed by 1 % of stray points.
Eigen::Vector2d bounding_sides(const VoxelCloud& cloud, const PlanarPatch& patch) {
  constexpr int kAngles = 30;  // Three-degree steps: within 0.2 % of the true area.
  Eigen::Vector2d best(1e9, 1e9);
  std::vector<Eigen::Vector2d> points;
  const std::size_t stride = std::max<std::size_t>(1, patch.voxels.size() / 500);
  for (std::size_t k = 0; k < patch.voxels.size(); k += stride) {
    points.push_back(patch.to_plane(cloud.voxels()[patch.voxels[k]].mean_m.cast<double>()));
  }
  std::vector<double> x(points.size());
  std::vector<double> y(points.size());
  for (int a = 0; a < kAngles; ++a) {
    const double angle = 0.5 * std::numbers::pi * a / kAngles;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    for (std::size_t k = 0; k < points.size(); ++k) {
      x[k] = c * points[k].x() + s * points[k].y();
      y[k] = -s * points[k].x() + c * points[k].y();
    }
    const Eigen::Vector2d sides(quantile(x, 0.99) - quantile(x, 0.01),
                                quantile(y, 0.99) - quantile(y, 0.01));
    if (sides.prod() < best.prod()) best = sides;
  }
  return {best.maxCoeff(), best.minCoeff()};
}

// Noise of the scene's planes: median deviation from local planes over a sample of places.
double measure_plane_noise(const VoxelCloud& cloud, const std::vector<std::uint32_t>& seeds,
                           double radius, double tolerance) {
  std::vector<double> deviations;
  std::vector<std::uint32_t> ids;
  const std::size_t stride = std::max<std::size_t>(1, seeds.size() / 150);
  for (std::size_t k = 0; k < seeds.size(); k += stride) {
    cloud.neighbours(cloud.voxels()[seeds[k]].mean_m, radius, ids);
    const auto plane = majority_plane(cloud, ids, tolerance, seeds[k]);
    if (!plane) continue;
    std::vector<double> distance;
    for (const auto i : within(cloud, ids, *plane, tolerance)) {
      distance.push_back(
          std::abs(plane->normal.dot(cloud.voxels()[i].mean_m.cast<double>() - plane->center)));
    }
    deviations.push_back(1.4826 * median(std::move(distance)));
  }
  return deviations.empty() ? tolerance / 3.0 : quantile(std::move(deviations), 0.75);
}

// How patches are grown.
struct PatchGrowth {
  const VoxelCloud& cloud;
  double tolerance;
  double short_side;
  double reach;
};

// Of planes: from their noise, within what still looks flat at the board's size.
double tolerance_of(const VoxelCloud& cloud, const std::vector<std::uint32_t>& seeds,
                    double short_side, double radius) {
  const double first = 0.03 * short_side;
  return std::clamp(3.0 * measure_plane_noise(cloud, seeds, radius, first), 0.3 * first,
                    2.0 * first);
}

// Whether a patch has about the board's size or more on both sides.
bool has_board_size(const PlanarPatch& patch, const PatchSearchOptions& options) {
  constexpr double kShare = 0.8;  // Lines leave up to their distance of a board unseen.
  const auto [shorter, longer] = std::minmax(options.board_width_m, options.board_height_m);
  return patch.open ||
         (patch.extent_m.x() > kShare * longer && patch.extent_m.y() > kShare * shorter);
}

// The patch about a seed, its extent not measured yet.
std::optional<PlanarPatch> grow(const PatchGrowth& by, std::uint32_t seed, LocalPlane plane,
                                const PatchConnection& connection) {
  const Eigen::Vector3d seed_point = by.cloud.voxels()[seed].mean_m.cast<double>();
  if (std::abs(plane.normal.dot(seed_point.normalized())) < kMinCosIncidence) return std::nullopt;
  std::vector<std::uint32_t> ids;
  by.cloud.neighbours(by.cloud.voxels()[seed].mean_m, by.reach, ids);
  PlanarPatch patch;
  // Twice: the first plane comes from a small neighbourhood, the second from the whole patch.
  for (int round = 0; round < 2; ++round) {
    patch.normal = plane.normal;
    patch.center_m = plane.center;
    plane_basis(patch.normal, patch.axis_u, patch.axis_v);
    const auto near = within(by.cloud, ids, plane, by.tolerance);
    const CellGrid grid(patch.to_plane(seed_point), connection.gap * by.short_side, by.reach);
    patch.voxels = connected_part(by.cloud, near, patch, grid, connection.cut_strips);
    const auto refit = least_squares_plane(by.cloud, patch.voxels);
    if (!refit || patch.voxels.size() < kMinNeighbours) return std::nullopt;
    plane = *refit;
  }
  return patch;
}

void measure(const PatchGrowth& by, std::uint32_t seed, PlanarPatch& patch) {
  const Eigen::Vector3d seed_point = by.cloud.voxels()[seed].mean_m.cast<double>();
  std::vector<double> distance;
  double farthest = 0.0;
  for (const auto i : patch.voxels) {
    const Eigen::Vector3d p = by.cloud.voxels()[i].mean_m.cast<double>();
    distance.push_back(std::abs(patch.normal.dot(p - patch.center_m)));
    farthest = std::max(farthest, (p - seed_point).norm());
  }
  patch.thickness_m = 1.4826 * median(std::move(distance));
  patch.open = farthest > 0.97 * by.reach;
  // An open patch is at least as large as what was searched.
  patch.extent_m =
      patch.open ? Eigen::Vector2d::Constant(2.0 * by.reach) : bounding_sides(by.cloud, patch);
}

}  // namespace

void plane_basis(const Eigen::Vector3d& normal, Eigen::Vector3d& axis_u, Eigen::Vector3d& axis_v) {
  // Start from the coordinate axis least aligned with the normal.
  Eigen::Index smallest = 0;
  normal.cwiseAbs().minCoeff(&smallest);
  axis_u = Eigen::Vector3d::Unit(smallest).cross(normal).normalized();
  axis_v = normal.cross(axis_u);
}

std::vector<PlanarPatch> find_planar_patches(const VoxelCloud& cloud,
                                             const PatchSearchOptions& options,
                                             const RunContext& context) {
  if (cloud.voxels().empty()) return {};
  const double short_side = std::min(options.board_width_m, options.board_height_m);
  const double radius = 0.3 * short_side;
  const auto seeds = cloud.cell_representatives();
  const double tolerance = options.plane_tolerance_m > 0
                               ? options.plane_tolerance_m
                               : tolerance_of(cloud, seeds, short_side, radius);
  const PatchGrowth by{cloud, tolerance, short_side,
                       1.1 * std::hypot(options.board_width_m, options.board_height_m)};
  std::vector<PlanarPatch> out;
  std::vector<std::uint32_t> ids;
  // The largest patch so far that holds a voxel: how many it has, and whether it is large enough.
  std::vector<std::size_t> largest(cloud.voxels().size(), 0);
  std::vector<char> large(cloud.voxels().size(), 0);
  for (const PatchConnection& connection : options.connections) {
    std::vector<char> covered(cloud.voxels().size(), 0);
    if (connection.grows_small) covered = large;
    for (const auto seed : seeds) {
      if (context.stopped()) return {};
      if (covered[seed] != 0) continue;
      cloud.neighbours(cloud.voxels()[seed].mean_m, radius, ids);
      const auto plane = majority_plane(cloud, ids, tolerance, seed);
      auto patch = plane ? grow(by, seed, *plane, connection) : std::nullopt;
      if (!patch) continue;
      for (const auto i : patch->voxels) covered[i] = 1;
      if (connection.grows_small && patch->voxels.size() <= largest[seed]) continue;
      measure(by, seed, *patch);
      const bool is_large = has_board_size(*patch, options);
      for (const auto i : patch->voxels) {
        largest[i] = std::max(largest[i], patch->voxels.size());
        if (is_large) large[i] = 1;
      }
      if (patch->extent_m.y() < options.smallest_side * short_side) continue;
      out.push_back(std::move(*patch));
    }
  }
  return out;
}

}  // namespace lvcalib
