// SPDX-License-Identifier: BSD-3-Clause
#include "model/scan_velocity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/statistics.h"

namespace lvcalib {
namespace {

constexpr std::size_t kNeighbours = 5;  // on either side

struct Ray {
  std::size_t point;
  double time_s;
  double azimuth;
  double elevation;
};

// An azimuth's difference, across ±π too.
double turned(double to, double from) {
  const double difference = to - from;
  if (difference > M_PI) return difference - 2.0 * M_PI;
  return difference < -M_PI ? difference + 2.0 * M_PI : difference;
}

// Velocity at a ray by a polynomial in time through it and its neighbours: of second order from
// five rays on, as scans are curved, and else straight.
Eigen::Vector2d velocity(const std::vector<Ray>& rays, std::size_t at, std::size_t begin,
                         std::size_t end) {
  const double unit = (rays[end - 1].time_s - rays[begin].time_s) / 2.0;
  if (!(unit > 0.0)) return Eigen::Vector2d::Zero();
  // Sums of powers of time, and of these times azimuth and elevation.
  std::array<double, 5> t{};
  Eigen::Matrix<double, 3, 2> moved = Eigen::Matrix<double, 3, 2>::Zero();
  for (std::size_t k = begin; k < end; ++k) {
    const double time = (rays[k].time_s - rays[at].time_s) / unit;
    const double square = time * time;
    t[0] += 1.0;
    t[1] += time;
    t[2] += square;
    t[3] += square * time;
    t[4] += square * square;
    const Eigen::RowVector2d by(turned(rays[k].azimuth, rays[at].azimuth),
                                rays[k].elevation - rays[at].elevation);
    moved.row(0) += by;
    moved.row(1) += time * by;
    moved.row(2) += square * by;
  }
  Eigen::RowVector2d slope;
  if (end - begin >= 5) {
    // Second row of the inverse of [t0 t1 t2; t1 t2 t3; t2 t3 t4].
    const double c0 = t[2] * t[3] - t[1] * t[4];
    const double c1 = t[0] * t[4] - t[2] * t[2];
    const double c2 = t[1] * t[2] - t[0] * t[3];
    const double determinant = t[1] * c0 + t[2] * c1 + t[3] * c2;
    slope = (c0 * moved.row(0) + c1 * moved.row(1) + c2 * moved.row(2)) / determinant;
  } else {
    slope = (t[0] * moved.row(1) - t[1] * moved.row(0)) / (t[0] * t[2] - t[1] * t[1]);
  }
  slope.x() *= std::cos(rays[at].elevation);
  const Eigen::Vector2d out = slope.transpose() / unit;
  return out.allFinite() ? out : Eigen::Vector2d::Zero().eval();
}

// The neighbours that the scanner passed without a break.
struct Stretch {
  std::size_t begin;
  std::size_t end;
};
Stretch stretch_about(const std::vector<Ray>& rays, std::size_t at, double longest_step) {
  Stretch out{at, at + 1};
  const auto joined = [&](std::size_t k) {  // ray k and the next
    return rays[k + 1].time_s - rays[k].time_s <= longest_step;
  };
  while (out.begin > 0 && at - out.begin < kNeighbours && joined(out.begin - 1)) --out.begin;
  while (out.end < rays.size() && out.end - at <= kNeighbours && joined(out.end - 1)) ++out.end;
  return out;
}

}  // namespace

std::vector<Eigen::Vector2d> scan_velocities(const Cloud& cloud) {
  if (!cloud.has_time()) return {};
  std::map<int, std::vector<Ray>> lines;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = cloud.points_m[i].cast<double>();
    // Clouds read with every point hold some that are no returns.
    if (!p.allFinite() || p.isZero(0.0) || !std::isfinite(cloud.time_s[i])) continue;
    lines[cloud.has_line() ? cloud.line[i] : 0].push_back(
        {i, cloud.time_s[i], std::atan2(p.y(), p.x()),
         std::atan2(p.z(), std::hypot(p.x(), p.y()))});
  }
  std::vector<Eigen::Vector2d> out(cloud.size(), Eigen::Vector2d::Zero());
  for (auto& [line, rays] : lines) {
    std::stable_sort(rays.begin(), rays.end(),
                     [](const Ray& a, const Ray& b) { return a.time_s < b.time_s; });
    std::vector<double> steps;
    for (std::size_t k = 1; k < rays.size(); ++k) {
      const double step = rays[k].time_s - rays[k - 1].time_s;
      if (step > 0.0) steps.push_back(step);
    }
    if (steps.size() < 2 * kNeighbours) continue;
    // A shot or two may be missing; after more the scanner may have been anywhere.
    const double longest = 3.5 * median(std::move(steps));
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const Stretch near = stretch_about(rays, k, longest);
      if (near.end - near.begin > 1) out[rays[k].point] = velocity(rays, k, near.begin, near.end);
    }
  }
  return out;
}

}  // namespace lvcalib
