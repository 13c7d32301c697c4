// SPDX-License-Identifier: BSD-3-Clause
#include "model/board_hits.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "base/statistics.h"
#include "model/noise_floor.h"
#include "model/scan_velocity.h"
#include "model/transition_width.h"

namespace lvcalib {

BoardHits::BoardHits(const SceneMeasurements& input, int scene, const SceneGeometry& geometry,
                     const Target& target, const TableOptions& options)
    : input_(input),
      scene_(scene),
      geometry_(geometry),
      target_(target),
      options_(options),
      nodes_(target.nodes()) {
  collect();
}

void BoardHits::collect() {
  const Cloud& cloud = *input_.board_points;
  const std::vector<Eigen::Vector2d> velocities = scan_velocities(cloud);
  const BoardOutline outline = target_.outline();
  const double shrink = 0.02 * outline.size_m().minCoeff();
  const Eigen::Vector2d low = outline.lower_left_m.array() + shrink;
  const Eigen::Vector2d high = outline.upper_right_m.array() - shrink;
  const auto& sigmas = input_.refinement->plane.group_sigma_m;
  const double gate =
      options_.gate * std::max({sigmas[0], sigmas[1], input_.refinement->plane.sigma_range_m});
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = cloud.points_m[i].cast<double>();
    const double measured = p.norm();
    BoardHit hit;
    hit.point = i;
    hit.beam.scene = scene_;
    if (!geometry_.describe(p / measured, hit.beam)) continue;
    const Eigen::Vector2d& xy = hit.beam.board_m;
    if ((xy.array() < low.array()).any() || (xy.array() > high.array()).any()) continue;
    hit.residual_m = measured - hit.beam.range_m;
    if (std::abs(hit.residual_m) > gate) continue;
    hit.print = print_at(xy);
    hit.pure = sees_only(hit.print, hit.beam, 2.0, 4);
    hit.plain = hit.pure && sees_only(hit.print, hit.beam, 3.0, 8);
    if (cloud.has_time()) hit.beam.time_s = cloud.time_s[i];
    if (cloud.has_line()) hit.beam.line = cloud.line[i];
    hit.beam.scan_rad_s = velocities.empty() ? Eigen::Vector2d::Zero() : velocities[i];
    set_near_edge(hit.beam);
    hits_.push_back(hit);
  }
  sort_hits();
}

// In the order of the scan, whatever order the file has: which rows are kept must not depend on it.
void BoardHits::sort_hits() {
  const auto key = [](const BoardHit& hit) {
    return std::tuple{hit.beam.time_s, hit.beam.line, hit.beam.azimuth_rad, hit.beam.elevation_rad,
                      hit.residual_m};
  };
  std::sort(hits_.begin(), hits_.end(),
            [&](const BoardHit& a, const BoardHit& b) { return key(a) < key(b); });
}

Print BoardHits::print_at(const Eigen::Vector2d& board_m) const {
  if (target_.albedo(board_m).value_or(1.0) >= 0.5) return Print::kWhite;
  for (const TargetNode& node : nodes_) {
    if ((board_m - node.center_m).norm() <= target_.circle_radius_m) return Print::kCircle;
  }
  return Print::kBlack;
}

// All prints so many σ of the footprint away are alike.
bool BoardHits::sees_only(Print print, const BeamPoint& beam, double sigmas, int directions) const {
  const double across = options_.footprint_rad * beam.range_m;
  for (int k = 0; k < directions; ++k) {
    const double psi = 2.0 * std::numbers::pi * k / directions;
    double sigma = transition_along(*input_.refinement, geometry_.lidar_from_board(), psi);
    if (sigma <= 0.0) sigma = across;
    const Eigen::Vector2d q =
        beam.board_m + sigmas * sigma * Eigen::Vector2d(std::cos(psi), std::sin(psi));
    if (print_at(q) != print) return false;
  }
  return true;
}

void BoardHits::set_near_edge(BeamPoint& beam) const {
  const double radius = target_.circle_radius_m;
  for (const TargetNode& node : nodes_) {
    const Eigen::Vector2d from = beam.board_m - node.center_m;
    const double distance = from.norm() - radius;
    if (std::abs(distance) > radius) continue;
    const double psi = std::atan2(from.y(), from.x());
    const double sigma = transition_along(*input_.refinement, geometry_.lidar_from_board(), psi);
    if (sigma > 0.0 && std::abs(distance) < 4.0 * sigma) beam.edge = NearEdge{distance, psi, sigma};
    return;
  }
}

std::array<double, kPrints> BoardHits::levels() const {
  std::array<double, kPrints> out{};
  const Cloud& cloud = *input_.board_points;
  if (!cloud.has_intensity()) return out;
  std::array<std::vector<double>, kPrints> values;
  for (const BoardHit& hit : hits_) {
    if (hit.plain)
      values[static_cast<std::size_t>(hit.print)].push_back(cloud.intensity[hit.point]);
  }
  const double white = values[0].empty() ? 0.0 : median(values[0]);
  for (std::size_t k = 0; k < kPrints; ++k) {
    // Black that returns next to nothing has no logarithm: a hundredth of white stands for it.
    if (values[k].size() >= 10) out[k] = std::max(median(std::move(values[k])), 0.01 * white);
  }
  return out;
}

PrintNoise BoardHits::noise() const {
  const Cloud& cloud = *input_.board_points;
  const FittedPlane& plane = input_.refinement->plane;
  PrintNoise out;
  for (std::size_t k = 0; k < kPrints; ++k) {
    Replicates ranges;
    Replicates logs;
    for (const BoardHit& hit : hits_) {
      if (hit.print != static_cast<Print>(k) || !hit.pure) continue;
      ranges.add(hit.beam, hit.residual_m);
      const double raw = cloud.has_intensity() ? cloud.intensity[hit.point] : 0.0;
      if (hit.plain) logs.add(hit.beam, std::log(std::max(raw, 1e-3)));
    }
    out.range_m[k] = ranges.sigma();
    if (out.range_m[k] == 0.0) {
      const double of_print = plane.group_sigma_m[std::min<std::size_t>(k, 1)];
      out.range_m[k] = of_print > 0.0 ? of_print : plane.sigma_range_m;
    }
    out.range_m[k] = std::max(out.range_m[k], 1e-5);
    out.log_intensity[k] = logs.sigma();
    // Structure widens the spread of all: weights that are too small do no harm.
    if (out.log_intensity[k] <= 0.0) out.log_intensity[k] = logs.spread();
  }
  return out;
}

}  // namespace lvcalib
