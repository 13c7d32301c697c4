// SPDX-License-Identifier: BSD-3-Clause
#include "response/angular_width.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "base/statistics.h"
#include "base/symmetric.h"
#include "response/transition_spread.h"

namespace lvcalib {
namespace {

constexpr std::size_t kFewestForWidth = 40;  // Six or seven for each unknown.

using Unknowns = Eigen::Matrix<double, 6, 1>;  // A_pp, A_py, A_yy, δ, μ_in, μ_out
using Normal = Eigen::Matrix<double, 6, 6>;

Eigen::Vector3d quadratic_terms(const BoundarySample& s) {
  const Eigen::Vector2d b = s.across_m.cast<double>();
  return {b.x() * b.x(), 2.0 * b.x() * b.y(), b.y() * b.y()};
}

struct WidthEquations {
  Normal normal = Normal::Zero();
  Normal scatter = Normal::Zero();  // Σ w² r² J Jᵀ
  Unknowns rhs = Unknowns::Zero();
};

// A sample beside what is predicted of it.
struct SeenSample {
  Eigen::Vector3d by_ellipse;
  double variance;
  double z;
  double lambda;
  double residual;
};

SeenSample seen(const BoundarySample& s, const Unknowns& x) {
  SeenSample out;
  out.by_ellipse = quadratic_terms(s);
  out.variance = std::max(1e-12, out.by_ellipse.dot(x.head<3>()));
  out.z = (static_cast<double>(s.distance_m) - x(3)) / std::sqrt(out.variance);
  out.lambda = normal_cdf(out.z);
  out.residual = static_cast<double>(s.intensity) - (x(4) + (x(5) - x(4)) * out.lambda);
  return out;
}

void measure_spread(const std::vector<const BoundarySample*>& samples, const PlateauLevels& levels,
                    const Unknowns& x, TransitionSpread& spread) {
  spread.clear();
  for (const BoundarySample* s : samples) {
    if (levels.is_stray(static_cast<double>(s->intensity))) continue;
    const SeenSample at = seen(*s, x);
    spread.add(at.lambda, at.residual, levels);
  }
  spread.finish();
}

WidthEquations equations_at(const Unknowns& x, const std::vector<const BoundarySample*>& samples,
                            const PlateauLevels& levels, const TransitionSpread& spread) {
  WidthEquations out;
  for (const BoundarySample* s : samples) {
    if (levels.is_stray(static_cast<double>(s->intensity))) continue;
    const SeenSample at = seen(*s, x);
    const double slope = (x(5) - x(4)) * normal_pdf(at.z);
    Unknowns j;
    j << -slope * at.z / (2.0 * at.variance) * at.by_ellipse, -slope / std::sqrt(at.variance),
        1.0 - at.lambda, at.lambda;
    const double weight = 1.0 / spread.variance(at.lambda, levels);
    out.normal += weight * j * j.transpose();
    out.scatter += weight * weight * at.residual * at.residual * j * j.transpose();
    out.rhs += weight * at.residual * j;
  }
  return out;
}

// Takes the step, keeping the ellipse positive and its growth within a factor of two. Returns by
// what share the ellipse changes.
double take(const Unknowns& step, Unknowns& x) {
  const Unknowns old = x;
  x += step;
  Eigen::Matrix2d a;
  a << x(0), x(1), x(1), x(2);
  const double trace = old(0) + old(2);
  const auto axes = axes_of(a);
  const Eigen::Vector2d bounded = axes.values.cwiseMax(0.01 * trace).cwiseMin(2.0 * trace);
  a = axes.vectors * bounded.asDiagonal() * axes.vectors.transpose();
  x.head<3>() << a(0, 0), a(0, 1), a(1, 1);
  return (x.head<3>() - old.head<3>()).norm() / trace;
}

std::optional<AngularWidth> width_of(const Unknowns& x, const WidthEquations& equations) {
  const Normal inverse = equations.normal.ldlt().solve(Normal::Identity());
  const Normal covariance = inverse * equations.scatter * inverse;
  const double trace = x(0) + x(2);
  const double variance = covariance(0, 0) + 2.0 * covariance(0, 2) + covariance(2, 2);
  if (!x.allFinite() || !(trace > 0.0) || !(variance >= 0.0)) return std::nullopt;
  AngularWidth out;
  out.covariance_rad2 << x(0), x(1), x(1), x(2);
  out.delta_m = x(3);
  out.relative_sigma = 0.5 * std::sqrt(variance) / trace;
  return out;
}

}  // namespace

std::optional<AngularWidth> fit_angular_width(const std::vector<const BoundarySample*>& samples) {
  if (samples.size() < kFewestForWidth) return std::nullopt;
  std::vector<double> width;
  std::vector<std::pair<double, double>> z;
  for (const BoundarySample* s : samples) {
    const double w = static_cast<double>(s->width_m);
    width.push_back(w / static_cast<double>(s->across_m.norm()));
    z.emplace_back(static_cast<double>(s->distance_m) / w, static_cast<double>(s->intensity));
  }
  const auto levels = plateau_levels(z);
  if (!levels || !levels->stand_clear()) return std::nullopt;
  // First ellipse: round, as wide as the samples say.
  const double round = std::pow(median(std::move(width)), 2);
  Unknowns x;
  x << round, 0.0, round, 0.0, levels->in, levels->out;
  // The spread is measured about the fit: the first rounds settle it together with the fit, then it
  // stands, so that the last ones converge.
  constexpr int kIterations = 30;
  constexpr int kSpreadRounds = 8;
  constexpr int kFewestRounds = 4;
  constexpr double kSettled = 1e-3;  // Far below what the samples can tell.
  TransitionSpread spread;
  double change = 1.0;
  for (int i = 0; i < kIterations && (i < kFewestRounds || change > kSettled); ++i) {
    if (i < kSpreadRounds) measure_spread(samples, *levels, x, spread);
    const WidthEquations equations = equations_at(x, samples, *levels, spread);
    const Unknowns step = equations.normal.ldlt().solve(equations.rhs);
    if (!step.allFinite()) return std::nullopt;
    change = take(step, x);
  }
  return width_of(x, equations_at(x, samples, *levels, spread));
}

}  // namespace lvcalib
