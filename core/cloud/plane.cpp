// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/plane.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "base/statistics.h"
#include "base/symmetric.h"

namespace lvcalib {
namespace {

constexpr std::size_t kMinPoints = 10;     // Three for each unknown.
constexpr double kMinCosIncidence = 0.02;  // Errors of the plane come fifty times along such rays.
// Tukey's constant for 98 % efficiency on Gaussian noise.
constexpr double kTukey = 6.0;
constexpr std::size_t kGroups = 4;
using GroupSigmas = std::array<double, kGroups>;

// Residuals of all points whose rays meet the plane; NaN for the others.
std::vector<double> range_residuals(std::span<const Eigen::Vector3f> points,
                                    const FittedPlane& plane) {
  std::vector<double> out(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    out[i] = plane.range_residual_m(points[i].cast<double>()).value_or(std::nan(""));
  }
  return out;
}

std::size_t group_of(std::span<const std::uint8_t> groups, std::size_t i) {
  return groups.empty() ? 0 : std::min<std::size_t>(groups[i], kGroups - 1);
}

// Robust σ of every group; one with too few points takes the σ of all.
GroupSigmas robust_sigmas(const std::vector<double>& residuals,
                          std::span<const std::uint8_t> groups, double& typical) {
  constexpr std::size_t kEnough = 6'000;  // Good to 1.5 %, where weights ask for no more than 10.
  const std::size_t stride = residuals.size() / kEnough + 1;
  std::array<std::vector<double>, kGroups> samples;
  std::vector<double> all;
  for (std::size_t i = 0; i < residuals.size(); i += stride) {
    if (!std::isfinite(residuals[i])) continue;
    samples[group_of(groups, i)].push_back(residuals[i]);
    all.push_back(residuals[i]);
  }
  const std::size_t total = all.size();
  // Float coordinates resolve a few tenths of a micrometre; never divide by less.
  const double common = total < kMinPoints ? 1e-6 : std::max(1e-6, mad_sigma(std::move(all)));
  GroupSigmas sigmas{};
  typical = common;
  for (std::size_t g = 0; g < kGroups; ++g) {
    const std::size_t count = samples[g].size();
    sigmas[g] = count < 5 * kMinPoints ? common : std::max(1e-6, mad_sigma(std::move(samples[g])));
    if (4 * count > total) typical = std::min(typical, sigmas[g]);
  }
  return sigmas;
}

struct PlaneSystem {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d rhs = Eigen::Vector3d::Zero();
  Eigen::Vector3d weighted_center = Eigen::Vector3d::Zero();
  double weight = 0.0;
  std::size_t inliers = 0;
};

// Moving the plane by height a and slopes b, c changes the range predicted for a ray that meets
// it at (u, v) by (a + b u + c v) / (n·ray).
PlaneSystem build_system(std::span<const Eigen::Vector3f> points, const FittedPlane& plane,
                         const std::vector<double>& residuals,
                         std::span<const std::uint8_t> groups) {
  PlaneSystem system;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(residuals[i])) continue;
    const double sigma = plane.group_sigma_m[group_of(groups, i)];
    const double w = tukey_weight(residuals[i] / sigma, kTukey) / (sigma * sigma);
    if (w <= 0) continue;
    const Eigen::Vector3d p = points[i].cast<double>();
    const double along = plane.normal.dot(p) / p.norm();
    const Eigen::Vector2d uv = plane.to_plane(p - residuals[i] * p.normalized());
    const Eigen::Vector3d j = Eigen::Vector3d(1.0, uv.x(), uv.y()) / along;
    system.normal += w * j * j.transpose();
    system.rhs += w * residuals[i] * j;
    system.weighted_center += w * p;
    system.weight += w;
    ++system.inliers;
  }
  return system;
}

// Robust mean residual of each group, with the group's own σ.
void measure_group_offsets(const std::vector<double>& residuals,
                           std::span<const std::uint8_t> groups, FittedPlane& plane) {
  std::array<double, kGroups> weight{};
  std::array<double, kGroups> sum{};
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (!std::isfinite(residuals[i])) continue;
    const std::size_t g = group_of(groups, i);
    const double w = tukey_weight(residuals[i] / plane.group_sigma_m[g], kTukey);
    weight[g] += w;
    sum[g] += w * residuals[i];
  }
  for (std::size_t g = 0; g < kGroups; ++g) {
    if (weight[g] < static_cast<double>(kMinPoints)) continue;
    plane.group_offset_m[g] = sum[g] / weight[g];
    plane.group_offset_sigma_m[g] = plane.group_sigma_m[g] / std::sqrt(weight[g]);
  }
}

void apply(FittedPlane& plane, const Eigen::Vector3d& step) {
  const Eigen::Vector3d normal =
      (plane.normal - step(1) * plane.axis_u - step(2) * plane.axis_v).normalized();
  plane.center_m += step(0) * plane.normal;
  // axis_u keeps its direction as far as the new normal allows.
  plane.axis_u = (plane.axis_u - normal * normal.dot(plane.axis_u)).normalized();
  plane.normal = normal;
  plane.axis_v = normal.cross(plane.axis_u);
}

}  // namespace

Eigen::Matrix3d PlaneFrame::turned(double angle_rad) const {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  Eigen::Matrix3d axes;
  axes.col(0) = c * axis_u + s * axis_v;
  axes.col(1) = -s * axis_u + c * axis_v;
  axes.col(2) = normal;
  return axes;
}

std::optional<Eigen::Vector2d> FittedPlane::ray_hit(const Eigen::Vector3d& point_m) const {
  const double along = normal.dot(point_m);
  if (std::abs(along) < kMinCosIncidence * point_m.norm()) return std::nullopt;
  return to_plane(point_m * (normal.dot(center_m) / along));
}

std::optional<double> FittedPlane::range_residual_m(const Eigen::Vector3d& point_m) const {
  const double range = point_m.norm();
  const double along = normal.dot(point_m);
  if (std::abs(along) < kMinCosIncidence * range) return std::nullopt;
  return range * (1.0 - normal.dot(center_m) / along);
}

std::optional<FittedPlane> fit_plane(std::span<const Eigen::Vector3f> points_m,
                                     const FittedPlane& start,
                                     std::span<const std::uint8_t> groups) {
  constexpr int kIterations = 8;
  if (points_m.size() < kMinPoints) return std::nullopt;
  FittedPlane plane = start;
  PlaneSystem system;
  for (int i = 0; i < kIterations; ++i) {
    const std::vector<double> residuals = range_residuals(points_m, plane);
    plane.group_sigma_m = robust_sigmas(residuals, groups, plane.sigma_range_m);
    system = build_system(points_m, plane, residuals, groups);
    const Eigen::LDLT<Eigen::Matrix3d> factor(system.normal);
    if (system.inliers < kMinPoints || factor.info() != Eigen::Success || factor.rcond() < 1e-9) {
      return std::nullopt;
    }
    const Eigen::Vector3d step = factor.solve(system.rhs);
    if (!step.allFinite()) return std::nullopt;
    apply(plane, step);
    // Stop well below the statistical error.
    if (std::abs(step(0)) * std::sqrt(system.weight) < 1e-3) break;
  }
  // Centre the frame on the points: height and slopes are then nearly uncorrelated.
  const Eigen::Vector3d mean = system.weighted_center / system.weight;
  plane.center_m = mean - plane.normal * plane.normal.dot(mean - plane.center_m);
  const std::vector<double> residuals = range_residuals(points_m, plane);
  system = build_system(points_m, plane, residuals, groups);
  plane.covariance = symmetric_inverse(system.normal);
  plane.inliers = system.inliers;
  measure_group_offsets(residuals, groups, plane);
  return plane;
}

void append_point(Cloud& to, const Cloud& from, std::size_t i) {
  to.points_m.push_back(from.points_m[i]);
  if (from.has_intensity()) to.intensity.push_back(from.intensity[i]);
  if (from.has_time()) to.time_s.push_back(from.time_s[i]);
  if (from.has_line()) to.line.push_back(from.line[i]);
}

}  // namespace lvcalib
