// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/scene_edits.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "refinement/node_fit.h"

namespace lvcalib {
namespace {

using Polygon = std::vector<Eigen::Vector2d>;

// Where the ray to a point meets the board's plane, in the board frame.
std::optional<Eigen::Vector2d> place_on_board(const Eigen::Vector3f& point_m,
                                              const Rigid3& board_from_lidar) {
  const Eigen::Vector3d from = board_from_lidar.translation;
  const Eigen::Vector3d to = board_from_lidar * point_m.cast<double>();
  const double share = from.z() / (from.z() - to.z());
  if (!std::isfinite(share) || share <= 0.0) return std::nullopt;
  return Eigen::Vector2d((from + share * (to - from)).head<2>());
}

// Even-odd rule.
bool contains_point(const Polygon& polygon, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[j];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

// Andrew's monotone chain.
Polygon convex_hull(Polygon points) {
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  const auto turn = [](const Eigen::Vector2d& o, const Eigen::Vector2d& a,
                       const Eigen::Vector2d& b) {
    return (a - o).x() * (b - o).y() - (a - o).y() * (b - o).x();
  };
  Polygon hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Eigen::Vector2d& p : points) {
      while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0.0)
        hull.pop_back();
      hull.push_back(p);
    }
    if (!hull.empty()) hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

void append_number(std::string& key, double value) {
  char text[40];
  key.append(text, std::to_chars(text, text + sizeof text, value).ptr);
  key += ' ';
}

Cloud part_of(const Cloud& cloud, const std::vector<std::uint32_t>& indices) {
  Cloud out;
  for (const std::uint32_t i : indices) {
    out.points_m.push_back(cloud.points_m[i]);
    if (cloud.has_intensity()) out.intensity.push_back(cloud.intensity[i]);
    if (cloud.has_time()) out.time_s.push_back(cloud.time_s[i]);
    if (cloud.has_line()) out.line.push_back(cloud.line[i]);
  }
  return out;
}

}  // namespace

bool contains_id(const std::vector<int>& ids, int id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

std::vector<std::uint32_t> left_out_points(const Cloud& cloud, const SceneEdits& edits,
                                           const Target& target, const Rigid3& lidar_from_board) {
  std::vector<std::uint32_t> out;
  std::set<std::array<float, 3>> single;
  for (const Eigen::Vector3f& p : edits.points_m) single.insert({p.x(), p.y(), p.z()});
  std::vector<Eigen::Vector2d> rings;
  if (target.has_circles()) {
    for (const TargetNode& node : target.nodes()) {
      if (contains_id(edits.circles, node.id)) rings.push_back(node.center_m);
    }
  }
  if (single.empty() && rings.empty() && edits.patches_m.empty()) return out;
  const NodeWindow window = rings.empty() ? NodeWindow{} : node_window(target);
  const Rigid3 board_from_lidar = lidar_from_board.inverse();
  const auto in_ring = [&](const Eigen::Vector2d& place, const Eigen::Vector2d& center) {
    const double off = (place - center).norm() - window.radius_m;
    return off >= -window.inside_m && off <= window.outside_m;
  };
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f& p = cloud.points_m[i];
    bool left_out = single.contains({p.x(), p.y(), p.z()});
    if (!left_out && !(rings.empty() && edits.patches_m.empty())) {
      const auto place = place_on_board(p, board_from_lidar);
      left_out =
          place && (std::any_of(rings.begin(), rings.end(),
                                [&](const auto& c) { return in_ring(*place, c); }) ||
                    std::any_of(edits.patches_m.begin(), edits.patches_m.end(),
                                [&](const Polygon& q) { return contains_point(q, *place); }));
    }
    if (left_out) out.push_back(static_cast<std::uint32_t>(i));
  }
  return out;
}

Cloud take_out(Cloud& cloud, const SceneEdits& edits, const Target& target,
               const Rigid3& lidar_from_board) {
  const auto out = left_out_points(cloud, edits, target, lidar_from_board);
  if (out.empty()) return {};
  Cloud taken = part_of(cloud, out);
  std::vector<std::uint32_t> rest;
  rest.reserve(cloud.size() - out.size());
  std::size_t next = 0;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (next < out.size() && out[next] == i) {
      ++next;
    } else {
      rest.push_back(i);
    }
  }
  Cloud kept = part_of(cloud, rest);
  kept.dropped = cloud.dropped;
  cloud = std::move(kept);
  return taken;
}

std::vector<CornerObservation> take_out(BoardView& view, const SceneEdits& edits) {
  std::vector<CornerObservation> out;
  if (edits.tags.empty()) return out;
  const auto left_out = [&](const CornerObservation& c) {
    return contains_id(edits.tags, c.feature_id);
  };
  std::set<int> ids;
  for (const CornerObservation& c : view.corners) {
    if (!left_out(c)) continue;
    out.push_back(c);
    ids.insert(c.feature_id);
  }
  std::erase_if(view.corners, left_out);
  view.tag_count = std::max(0, view.tag_count - static_cast<int>(ids.size()));
  return out;
}

std::string refinement_key(const SceneEdits& edits) {
  std::string key;
  for (const Eigen::Vector3f& p : edits.points_m) {
    for (const float x : p) append_number(key, static_cast<double>(x));
  }
  for (const Polygon& patch : edits.patches_m) {
    key += "patch ";
    for (const Eigen::Vector2d& p : patch) {
      append_number(key, p.x());
      append_number(key, p.y());
    }
  }
  for (const int id : edits.circles) key += "circle " + std::to_string(id) + ' ';
  return key;
}

Polygon patch_about(const std::vector<Eigen::Vector3f>& points_m, const Rigid3& lidar_from_board) {
  constexpr double kMargin_m = 1e-3;
  const Rigid3 board_from_lidar = lidar_from_board.inverse();
  Polygon places;
  for (const Eigen::Vector3f& p : points_m) {
    const auto place = place_on_board(p, board_from_lidar);
    if (!place) continue;
    for (const double x : {-kMargin_m, kMargin_m}) {
      for (const double y : {-kMargin_m, kMargin_m})
        places.emplace_back(*place + Eigen::Vector2d(x, y));
    }
  }
  return convex_hull(std::move(places));
}

Polygon ring_patch(const Target& target, int circle, double from_rad, double to_rad) {
  Polygon out;
  if (!target.has_circles()) return out;
  const NodeWindow window = node_window(target);
  if (to_rad < from_rad) to_rad += 2.0 * std::numbers::pi;
  constexpr int kSteps = 6;  // A chord of a bin's sixth stays within a tenth of a millimetre.
  for (const TargetNode& node : target.nodes()) {
    if (node.id != circle) continue;
    for (const double radius :
         {window.radius_m + window.outside_m, std::max(0.0, window.radius_m - window.inside_m)}) {
      const bool outer = out.empty();
      for (int k = 0; k <= kSteps; ++k) {
        const double share = static_cast<double>(outer ? k : kSteps - k) / kSteps;
        const double angle = from_rad + share * (to_rad - from_rad);
        out.emplace_back(node.center_m +
                         radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      }
    }
  }
  return out;
}

}  // namespace lvcalib
