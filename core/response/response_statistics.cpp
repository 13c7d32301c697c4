// SPDX-License-Identifier: BSD-3-Clause
#include "response/response_statistics.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "base/statistics.h"
#include "base/symmetric.h"

namespace lvcalib {
namespace {

// (b_p², 2 b_p b_y, b_y²): bᵀAb as a linear function of A's three entries.
Eigen::Vector3d quadratic_terms(const Eigen::Vector2f& b) {
  const Eigen::Vector2d v = b.cast<double>();
  return {v.x() * v.x(), 2.0 * v.x() * v.y(), v.y() * v.y()};
}

double squared(double x) {
  return x * x;
}

// Variance of the range residuals at the edge itself: on the dark and the white side it differs,
// so that it is read off a parabola through the squares at d = δ.
double range_variance_at_edge(const OverlapSet& set, const Eigen::Matrix2d& angular, double share) {
  std::vector<double> all;
  for (const BoundarySample* s : set.samples)
    all.push_back(static_cast<double>(s->range_residual_m));
  const double cut = 5.0 * mad_sigma(std::move(all));
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d rhs = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < set.samples.size(); ++k) {
    const BoundarySample& s = *set.samples[k];
    const double e = static_cast<double>(s.range_residual_m);
    if (std::abs(e) > cut) continue;
    const double z = (static_cast<double>(s.distance_m) - set.shift_m[k]) / set.half_width_m[k];
    const Eigen::Vector2d g = s.slant_m.cast<double>();
    const Eigen::Vector3d j(1.0, z, z * z);
    normal += j * j.transpose();
    rhs += j * (e * e - share * g.dot(angular * g));
  }
  const Eigen::Vector3d fit = normal.ldlt().solve(rhs);
  return fit.allFinite() ? std::max(0.0, fit(0)) : 0.0;
}

// Covariance of range with pitch and yaw: E[d·e | b] = cᵀb, the region's variance scaled to one σ.
Eigen::Vector2d range_covariance(const OverlapSet& set) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d rhs = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < set.samples.size(); ++k) {
    const BoundarySample& s = *set.samples[k];
    const Eigen::Vector2d b = s.across_m.cast<double>();
    const double width = static_cast<double>(s.width_m);
    const double scale = std::sqrt(3.0) * width / set.half_width_m[k];
    normal += b * b.transpose();
    rhs += b * (scale * (static_cast<double>(s.distance_m) - set.shift_m[k]) *
                static_cast<double>(s.range_residual_m));
  }
  const Eigen::Vector2d c = normal.ldlt().solve(rhs);
  return c.allFinite() ? c : Eigen::Vector2d::Zero().eval();
}

void paired_moments(const OverlapSet& set, ResponseStatistics& out) {
  const double n = static_cast<double>(set.samples.size());
  for (const BoundarySample* s : set.samples) out.mean += s->residual.cast<double>() / n;
  for (const BoundarySample* s : set.samples) {
    const Eigen::Vector3d d = s->residual.cast<double>() - out.mean;
    out.paired += d * d.transpose() / (n - 1.0);
  }
  out.mean_sigma = (out.paired.diagonal() / n).cwiseSqrt();
}

}  // namespace

void OverlapSet::append(const OverlapSet& other) {
  const double before = static_cast<double>(samples.size());
  const double more = static_cast<double>(other.samples.size());
  samples.insert(samples.end(), other.samples.begin(), other.samples.end());
  half_width_m.insert(half_width_m.end(), other.half_width_m.begin(), other.half_width_m.end());
  shift_m.insert(shift_m.end(), other.shift_m.begin(), other.shift_m.end());
  // Widths of different scenes err independently.
  if (before + more > 0) {
    relative_width_sigma = std::sqrt(squared(before * relative_width_sigma) +
                                     squared(more * other.relative_width_sigma)) /
                           (before + more);
  }
}

Eigen::Matrix2d angular_covariance(const OverlapSet& set) {
  // d² scatters in proportion to itself: weigh by the region's own variance.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d rhs = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < set.samples.size(); ++k) {
    const BoundarySample& s = *set.samples[k];
    const double width_sq = squared(static_cast<double>(s.width_m));
    const double expected = squared(set.half_width_m[k]) / 3.0;  // of a uniform distribution
    const double weight = 1.0 / (expected * expected);
    const Eigen::Vector3d j = expected / width_sq * quadratic_terms(s.across_m);
    const double d = static_cast<double>(s.distance_m) - set.shift_m[k];
    normal += weight * j * j.transpose();
    rhs += weight * j * d * d;
  }
  const Eigen::Vector3d a = normal.ldlt().solve(rhs);
  if (!a.allFinite()) return Eigen::Matrix2d::Zero();
  Eigen::Matrix2d angular;
  angular << a(0), a(1), a(1), a(2);
  // Noise may push a thin ellipse below zero.
  return without_negative_axes(angular);
}

JitterShare measure_jitter_share(const std::vector<const BoundarySample*>& samples,
                                 const Eigen::Matrix2d& angular) {
  if (samples.empty()) return {};
  std::vector<double> all;
  for (const BoundarySample* s : samples) all.push_back(static_cast<double>(s->range_residual_m));
  const double sigma = mad_sigma(std::move(all));
  if (!(sigma > 0.0)) return {};
  // Unknowns: the variance on black, in the transition, on white; the share.
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d rhs = Eigen::Vector4d::Zero();
  for (const BoundarySample* s : samples) {
    const double e = static_cast<double>(s->range_residual_m);
    if (std::abs(e) > 6.0 * sigma) continue;
    const double z = static_cast<double>(s->distance_m) / static_cast<double>(s->width_m);
    const Eigen::Vector2d g = s->slant_m.cast<double>();
    Eigen::Vector4d j = Eigen::Vector4d::Zero();
    j(z < -1.5 ? 0 : (z > 1.5 ? 2 : 1)) = 1.0;
    j(3) = g.dot(angular * g);
    normal += j * j.transpose();
    rhs += j * e * e;
  }
  for (int k = 0; k < 3; ++k) {
    if (normal(k, k) <= 0.0) normal(k, k) = 1.0;
  }
  const Eigen::LDLT<Eigen::Matrix4d> factor(normal);
  const Eigen::Vector4d fit = factor.solve(rhs);
  const Eigen::Vector4d unit = factor.solve(Eigen::Vector4d::Unit(3));
  if (!fit.allFinite() || !(unit(3) > 0.0)) return {};
  // Squares of Gaussian residuals have the variance 2σ⁴.
  const double error = std::sqrt(2.0 * unit(3)) * sigma * sigma;
  constexpr double kTooVague = 0.5;  // Half of all that a share can be.
  if (!(error < kTooVague)) return {};
  return {std::clamp(fit(3), 0.0, 1.0), error};
}

std::optional<ResponseStatistics> summarize_response(const OverlapSet& set,
                                                     const JitterShare& jitter, int min_samples) {
  if (static_cast<int>(set.samples.size()) < std::max(3, min_samples)) return std::nullopt;
  // Pitch and yaw can be told apart only if edges face both ways.
  Eigen::Matrix2d directions = Eigen::Matrix2d::Zero();
  for (const BoundarySample* s : set.samples) {
    const Eigen::Vector2d b = s->across_m.cast<double>().normalized();
    directions += b * b.transpose() / static_cast<double>(set.samples.size());
  }
  constexpr double kOneSided = 0.1;  // All round: 0.5; all within 32° of one line: 0.1.
  if (axes_of(directions).values(0) < kOneSided) return std::nullopt;
  ResponseStatistics out;
  out.n = static_cast<int>(set.samples.size());
  paired_moments(set, out);
  const Eigen::Matrix2d angular = angular_covariance(set);
  out.covariance.topLeftCorner<2, 2>() = angular;
  out.covariance(2, 2) = range_variance_at_edge(set, angular, jitter.share);
  const Eigen::Vector2d cross = range_covariance(set);
  out.covariance(0, 2) = out.covariance(2, 0) = cross.x();
  out.covariance(1, 2) = out.covariance(2, 1) = cross.y();
  // Uniform d: the variance of d² is 4/5 of its square; two directions share the samples. Ranges:
  // the value of a parabola at its middle costs 9/4 of a mean's variance, 2σ⁴ each.
  const double n = out.n;
  const double angular_relative = std::sqrt(squared(set.relative_width_sigma) + 0.4 / n);
  const Eigen::Vector3d std_dev = out.std_dev();
  out.std_sigma << angular_relative * std_dev(0), angular_relative * std_dev(1),
      std::sqrt(9.0 / 8.0 / n) * std_dev(2);
  return out;
}

}  // namespace lvcalib
