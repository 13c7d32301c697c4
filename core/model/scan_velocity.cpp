// SPDX-License-Identifier: BSD-3-Clause
#include "model/scan_velocity.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/statistics.h"

namespace lvcalib {
namespace {

constexpr int kNeighbours = 5;  // on either side

struct Ray {
  std::size_t point;
  double time_s;
  double azimuth;
  double elevation;
};

Eigen::Vector2d slope(const std::vector<Ray>& rays, std::size_t at, std::size_t begin,
                      std::size_t end) {
  double n = 0, t = 0, tt = 0;
  Eigen::Vector2d y = Eigen::Vector2d::Zero();
  Eigen::Vector2d ty = Eigen::Vector2d::Zero();
  for (std::size_t k = begin; k < end; ++k) {
    const double dt = rays[k].time_s - rays[at].time_s;
    const Eigen::Vector2d v(
        std::remainder(rays[k].azimuth - rays[at].azimuth, 2 * M_PI) * std::cos(rays[at].elevation),
        rays[k].elevation - rays[at].elevation);
    n += 1;
    t += dt;
    tt += dt * dt;
    y += v;
    ty += dt * v;
  }
  const double spread = n * tt - t * t;
  return spread > 0.0 ? Eigen::Vector2d((n * ty - t * y) / spread) : Eigen::Vector2d::Zero().eval();
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
    const double longest = 10.0 * (2 * kNeighbours) * median(std::move(steps));
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const std::size_t begin = k < kNeighbours ? 0 : k - kNeighbours;
      const std::size_t end = std::min(rays.size(), k + kNeighbours + 1);
      if (end - begin < 5 || rays[end - 1].time_s - rays[begin].time_s > longest) continue;
      out[rays[k].point] = slope(rays, k, begin, end);
    }
  }
  return out;
}

}  // namespace lvcalib
