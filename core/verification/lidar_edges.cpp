// SPDX-License-Identifier: BSD-3-Clause
#include "verification/lidar_edges.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>

#include <Eigen/Geometry>

#include "base/statistics.h"

namespace lvcalib {
namespace {

// Ranges of one surface differ by their noise, some centimetres at most; what stands before
// something else by less than a decimetre shows little in a camera beside the LiDAR.
constexpr double kLeastJump_m = 0.1;
// The same at long range, where a footprint of 2 mrad is as wide as its surface is rough.
constexpr double kLeastJumpShare = 0.02;
// Between neighbours a surface changes its range evenly; twice, for noise, twice, for curvature.
constexpr double kSlopes = 4.0;
// Neighbours are no further apart than this many usual steps; else a return is missing between.
constexpr double kSteps = 4.0;
// Points averaged on either side of a step of the intensity.
constexpr std::size_t kSide = 3;
// And those that must lie on one flat surface: as many again, as far as a footprint of two steps.
constexpr std::size_t kReach = 2 * kSide;
// How flat: three times the range's noise of 10 to 20 mm, and what grazing makes of a footprint.
constexpr double kFlat_m = 0.05;
constexpr double kFlatShare = 0.005;
constexpr double kIntensitySigmas = 6.0;
constexpr double kIntensityShare = 0.1;
// Neighbours of a scanned cloud are nearer than its points are to each other on average, unless
// the order is lost: then they are as far apart as any two, hundreds of times more.
constexpr double kOrderLost = 20.0;

using Index = std::uint32_t;
using Track = std::vector<Index>;

struct Rays {
  std::vector<Eigen::Vector3d> direction;
  std::vector<double> range_m;
};

Rays rays_of(const Cloud& cloud) {
  Rays out;
  out.direction.reserve(cloud.size());
  out.range_m.reserve(cloud.size());
  for (const Eigen::Vector3f& p : cloud.points_m) {
    const Eigen::Vector3d point = p.cast<double>();
    const double range = point.norm();
    out.range_m.push_back(range);
    out.direction.emplace_back(point / std::max(range, 1e-12));
  }
  return out;
}

std::vector<Track> tracks_of_lines(const Cloud& cloud) {
  std::map<std::uint16_t, Track> lines;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    lines[cloud.has_line() ? cloud.line[i] : std::uint16_t{0}].push_back(static_cast<Index>(i));
  std::vector<Track> out;
  for (auto& [line, track] : lines) out.push_back(std::move(track));
  return out;
}

// Median angle between points that follow each other; 0 for none.
double usual_step(const Rays& rays, const std::vector<Track>& tracks) {
  std::vector<double> steps;
  for (const Track& track : tracks) {
    // Every seventh is enough for a median, and no period of a scanner.
    for (std::size_t k = 1; k < track.size(); k += 7)
      steps.push_back((rays.direction[track[k]] - rays.direction[track[k - 1]]).norm());
  }
  return steps.empty() ? 0.0 : median(std::move(steps));
}

// Rows and columns of a grid about an axis, in the half ahead of it; the cell's side in `cell`.
std::vector<Track> tracks_of_grid(const Rays& rays, const Eigen::Vector3d& axis, double& cell) {
  const Eigen::Vector3d ahead = axis.normalized();
  const Eigen::Vector3d u = ahead.unitOrthogonal();
  const Eigen::Vector3d v = ahead.cross(u);
  struct Place {
    double u, v;
    Index index;
  };
  std::vector<Place> places;
  for (std::size_t i = 0; i < rays.direction.size(); ++i) {
    const double forward = rays.direction[i].dot(ahead);
    // Within 60° of the axis, where the projection still keeps areas within a factor of eight.
    if (forward < 0.5) continue;
    places.push_back({rays.direction[i].dot(u) / forward, rays.direction[i].dot(v) / forward,
                      static_cast<Index>(i)});
  }
  if (places.size() < 4) return {};
  std::vector<double> us, vs;
  for (const Place& p : places) us.push_back(p.u), vs.push_back(p.v);
  const double area =
      (quantile(us, 0.95) - quantile(us, 0.05)) * (quantile(vs, 0.95) - quantile(vs, 0.05)) / 0.81;
  // Two points a cell: a row then crosses each edge about as often as there are rows.
  cell = std::sqrt(std::max(1e-12, 2.0 * area / static_cast<double>(places.size())));
  std::vector<Track> out;
  for (const bool rows : {true, false}) {
    std::map<long, std::vector<Place>> lines;
    for (const Place& p : places) lines[std::lround((rows ? p.v : p.u) / cell)].push_back(p);
    for (auto& [line, members] : lines) {
      std::sort(members.begin(), members.end(),
                [rows](const Place& a, const Place& b) { return rows ? a.u < b.u : a.v < b.v; });
      Track track;
      for (const Place& p : members) track.push_back(p.index);
      out.push_back(std::move(track));
    }
  }
  return out;
}

class Follower {
 public:
  Follower(const Cloud& cloud, const Rays& rays, double step)
      : cloud_(cloud), rays_(rays), widest_(kSteps * step) {
    if (!cloud.has_contrast()) return;
    std::vector<double> values, second;
    for (std::size_t i = 0; i < cloud.size(); i += 1 + cloud.size() / 20000)
      values.push_back(cloud.intensity[i]);
    contrast_ = quantile(values, 0.98) - quantile(values, 0.02);
  }

  void follow(const Track& track) {
    intensity_sigma_ = intensity_noise(track);
    for (std::size_t k = 1; k + 1 < track.size();) k = range_edge(track, k);
    if (contrast_ > 0.0 && intensity_sigma_ > 0.0) intensity_edges(track);
  }

  std::vector<LidarEdge> take() { return std::move(edges_); }

 private:
  [[nodiscard]] double angle(Index a, Index b) const {
    return (rays_.direction[a] - rays_.direction[b]).norm();
  }
  [[nodiscard]] bool neighbours(const Track& t, std::size_t a, std::size_t b) const {
    return angle(t[a], t[b]) <= widest_ * static_cast<double>(b - a);
  }

  // One standard deviation of an intensity, from what three points in a row do not share with a
  // straight line: the difference of the second order has the variance 6σ².
  [[nodiscard]] double intensity_noise(const Track& t) const {
    if (contrast_ <= 0.0) return 0.0;
    std::vector<double> second;
    for (std::size_t k = 1; k + 1 < t.size(); ++k) {
      second.push_back(std::abs(cloud_.intensity[t[k - 1]] - 2.0 * cloud_.intensity[t[k]] +
                                cloud_.intensity[t[k + 1]]));
    }
    if (second.empty()) return 0.0;
    // A device that gives whole numbers may show no noise at all: half a step then.
    return std::max(1.4826 * median(std::move(second)) / std::sqrt(6.0), 0.002 * contrast_);
  }

  void add(LidarEdge::Kind kind, Index near, Index far) {
    const Eigen::Vector3d middle = (rays_.direction[near] + rays_.direction[far]).normalized();
    const Eigen::Vector3d step = rays_.direction[far] - rays_.direction[near];
    if (step.norm() < 1e-9) return;
    edges_.push_back({kind, std::min(rays_.range_m[near], rays_.range_m[far]) * middle,
                      step.normalized(), step.norm()});
  }

  // Looks for a jump behind place k and gives the place from which to go on.
  std::size_t range_edge(const Track& t, std::size_t k) {
    const auto range = [&](std::size_t i) { return rays_.range_m[t[i]]; };
    for (std::size_t far = k + 1; far <= k + 2 && far + 1 < t.size(); ++far) {
      if (!neighbours(t, k - 1, k) || !neighbours(t, k, far) || !neighbours(t, far, far + 1))
        continue;
      const double jump = std::abs(range(far) - range(k));
      const double slope =
          std::max(std::abs(range(k) - range(k - 1)), std::abs(range(far + 1) - range(far)));
      if (jump < kLeastJump_m + kLeastJumpShare * std::min(range(k), range(far)) ||
          jump < kSlopes * slope * static_cast<double>(far - k))
        continue;
      // What lies between must be between, and not on the first surface: the edge comes later then.
      if (far == k + 2 && ((range(k + 1) - range(k)) * (range(far) - range(k + 1)) < 0.0 ||
                           std::abs(range(k + 1) - range(k)) < std::max(kLeastJump_m, slope)))
        continue;
      if (range(k) < range(far)) {
        add(LidarEdge::Kind::kRange, t[k], t[far]);
      } else {
        add(LidarEdge::Kind::kRange, t[far], t[k]);
      }
      return far;
    }
    return k + 1;
  }

  // Whether the points about the step between places k and k + 1 lie on one flat surface, with room
  // on either side: near its end a beam meets what is behind as well, which changes the intensity.
  [[nodiscard]] bool on_one_surface(const Track& t, std::size_t k) const {
    double sum = 0.0, slope = 0.0, square = 0.0;
    const std::size_t first = k + 1 - kReach;
    for (std::size_t j = 0; j < 2 * kReach; ++j) {
      if (j > 0 && !neighbours(t, first + j - 1, first + j)) return false;
      const double x = static_cast<double>(j) - (kReach - 0.5);
      sum += rays_.range_m[t[first + j]];
      slope += x * rays_.range_m[t[first + j]];
      square += x * x;
    }
    const double mean = sum / (2.0 * kReach);
    slope /= square;
    for (std::size_t j = 0; j < 2 * kReach; ++j) {
      const double x = static_cast<double>(j) - (kReach - 0.5);
      if (std::abs(rays_.range_m[t[first + j]] - mean - slope * x) > kFlat_m + kFlatShare * mean)
        return false;
    }
    return true;
  }

  // Step of the intensity between places k and k + 1.
  [[nodiscard]] double intensity_step(const Track& t, std::size_t k) const {
    double sum = 0.0;
    for (std::size_t j = 0; j < kSide; ++j)
      sum += cloud_.intensity[t[k + 1 + j]] - cloud_.intensity[t[k - j]];
    return sum / static_cast<double>(kSide);
  }

  void intensity_edges(const Track& t) {
    if (t.size() < 2 * kReach + 1) return;
    const double least = std::max(kIntensitySigmas * std::sqrt(2.0 / kSide) * intensity_sigma_,
                                  kIntensityShare * contrast_);
    std::size_t best = 0;
    double best_step = 0.0;
    // The largest step of a group of neighbours that all are steps.
    const auto close = [&] {
      if (best_step != 0.0 && on_one_surface(t, best)) {
        const std::size_t darker = best_step > 0.0 ? best + 1 : best;
        add(LidarEdge::Kind::kIntensity, t[2 * best + 1 - darker], t[darker]);
      }
      best_step = 0.0;
    };
    for (std::size_t k = kReach - 1; k + kReach < t.size(); ++k) {
      // Towards the darker side counts as positive.
      const double step = -intensity_step(t, k);
      if (std::abs(step) < least) {
        close();
        continue;
      }
      if (step * best_step < 0.0) close();
      if (std::abs(step) > std::abs(best_step)) best = k, best_step = step;
    }
    close();
  }

  const Cloud& cloud_;
  const Rays& rays_;
  double widest_;
  double contrast_ = 0.0;
  double intensity_sigma_ = 0.0;
  std::vector<LidarEdge> edges_;
};

}  // namespace

std::vector<LidarEdge> lidar_edges(const Cloud& cloud, const Eigen::Vector3d& axis) {
  const Rays rays = rays_of(cloud);
  std::vector<Track> tracks = tracks_of_lines(cloud);
  double step = usual_step(rays, tracks);
  double cell = 0.0;
  std::vector<Track> grid;
  // The mean spacing needs the grid anyway; it is made only where the order may be lost.
  constexpr double kScannersStep = 0.02;
  if (step > kScannersStep || step == 0.0) grid = tracks_of_grid(rays, axis, cell);
  if (!grid.empty() && (step == 0.0 || step > kOrderLost * cell)) {
    tracks = std::move(grid);
    step = usual_step(rays, tracks);
  }
  Follower follower(cloud, rays, step);
  for (const Track& track : tracks) follower.follow(track);
  return follower.take();
}

}  // namespace lvcalib
