// SPDX-License-Identifier: BSD-3-Clause
#include "model/scan_velocity.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Cholesky>

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

// Velocity at a ray by a polynomial in time through it and its neighbours: of second order from
// five rays on, as scans are curved, and else straight.
Eigen::Vector2d velocity(const std::vector<Ray>& rays, std::size_t at, std::size_t begin,
                         std::size_t end) {
  const double unit = (rays[end - 1].time_s - rays[begin].time_s) / 2.0;
  if (!(unit > 0.0)) return Eigen::Vector2d::Zero();
  const int order = end - begin >= 5 ? 2 : 1;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> rhs = Eigen::Matrix<double, 3, 2>::Zero();
  for (std::size_t k = begin; k < end; ++k) {
    const double t = (rays[k].time_s - rays[at].time_s) / unit;
    const Eigen::Vector3d powers(1.0, t, t * t);
    const Eigen::RowVector2d moved(
        std::remainder(rays[k].azimuth - rays[at].azimuth, 2 * M_PI) * std::cos(rays[at].elevation),
        rays[k].elevation - rays[at].elevation);
    normal += powers * powers.transpose();
    rhs += powers * moved;
  }
  const int n = order + 1;
  const Eigen::MatrixXd fit = normal.topLeftCorner(n, n).ldlt().solve(rhs.topRows(n));
  const Eigen::Vector2d out = fit.row(1).transpose() / unit;
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
