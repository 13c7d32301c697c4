// SPDX-License-Identifier: BSD-3-Clause
#include "response/transition_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

#include "base/statistics.h"
#include "response/transition_spread.h"

namespace lvcalib {
namespace {

using Levels = PlateauLevels;

constexpr std::size_t kFewestForFit = 20;  // Five for each unknown.

std::optional<Levels> levels_of(std::span<const TransitionPoint> points, double delta_m,
                                double sigma_m) {
  std::vector<std::pair<double, double>> samples;
  samples.reserve(points.size());
  for (const TransitionPoint& p : points)
    samples.emplace_back((p.distance_m - delta_m) / sigma_m, p.intensity);
  return plateau_levels(samples);
}

using Vector4d = Eigen::Matrix<double, 4, 1>;
using Matrix4d = Eigen::Matrix<double, 4, 4>;

struct System {
  Matrix4d normal = Matrix4d::Zero();
  Matrix4d scatter = Matrix4d::Zero();  // Σ w² r² J Jᵀ
  Vector4d rhs = Vector4d::Zero();
  int used = 0;
};

void measure_spread(std::span<const TransitionPoint> points, const Levels& levels,
                    const Vector4d& x, TransitionSpread& spread) {
  spread.clear();
  for (const TransitionPoint& p : points) {
    if (levels.is_stray(p.intensity)) continue;
    const double z = (p.distance_m - x(2)) / x(3);
    const double lambda = normal_cdf(z);
    spread.add(lambda, p.intensity - (x(0) + (x(1) - x(0)) * lambda), levels);
  }
  spread.finish();
}

System system_at(const Vector4d& x, std::span<const TransitionPoint> points, const Levels& levels,
                 const TransitionSpread& spread) {
  System s;
  for (const TransitionPoint& p : points) {
    if (levels.is_stray(p.intensity)) continue;
    const double z = (p.distance_m - x(2)) / x(3);
    const double lambda = normal_cdf(z);
    const double r = p.intensity - (x(0) + (x(1) - x(0)) * lambda);
    const double weight = 1.0 / spread.variance(lambda, levels);
    const double slope = (x(1) - x(0)) * normal_pdf(z) / x(3);
    const Vector4d j(1.0 - lambda, lambda, -slope, -slope * z);
    s.normal += weight * j * j.transpose();
    s.scatter += weight * weight * r * r * j * j.transpose();
    s.rhs += weight * r * j;
    ++s.used;
  }
  return s;
}

// Weighted least squares of the mean level. A jittering beam makes levels in the transition jump
// between black and white, skewed on either side: any loss that favours the bulk would be pulled
// to the nearer level. So all samples between the levels count by their squares, weighed by the
// mean square at their place; only what no mixture of black and white gives is left out.
bool fit(std::span<const TransitionPoint> points, const Levels& levels, Vector4d& x,
         TransitionSpread& spread) {
  // The spread is measured about the fit: the first rounds settle it together with the fit, then it
  // stands, so that the last ones converge.
  constexpr int kIterations = 30;
  constexpr int kSpreadRounds = 8;
  constexpr int kFewestRounds = 4;
  constexpr double kSettled = 1e-4;
  for (int i = 0; i < kIterations; ++i) {
    if (i < kSpreadRounds) measure_spread(points, levels, x, spread);
    const System s = system_at(x, points, levels, spread);
    if (s.used < static_cast<int>(kFewestForFit)) return false;
    const Eigen::LDLT<Matrix4d> factor(s.normal);
    if (factor.info() != Eigen::Success) return false;
    Vector4d step = factor.solve(s.rhs);
    if (!step.allFinite()) return false;
    // Width and place move by at most half a width at a time.
    const double limit = 0.5 * x(3);
    const double longest = std::max(std::abs(step(2)), std::abs(step(3)));
    if (longest > limit) step *= limit / longest;
    x += step;
    if (i >= kFewestRounds && longest < kSettled * x(3)) break;
  }
  return x.allFinite() && x(3) > 0.0;
}

}  // namespace

std::optional<TransitionFit> fit_transition(std::span<const TransitionPoint> points,
                                            double sigma_start_m) {
  if (points.size() < kFewestForFit || !(sigma_start_m > 0.0)) return std::nullopt;
  const auto levels = levels_of(points, 0.0, sigma_start_m);
  if (!levels || !levels->stand_clear()) return std::nullopt;
  Vector4d x(levels->in, levels->out, 0.0, sigma_start_m);
  TransitionSpread spread;
  if (!fit(points, *levels, x, spread)) return std::nullopt;
  const System last = system_at(x, points, *levels, spread);
  TransitionFit out;
  out.samples = last.used;
  // H⁻¹ (Σ w² r² J Jᵀ) H⁻¹
  const Matrix4d inverse = last.normal.ldlt().solve(Matrix4d::Identity());
  const Matrix4d covariance = inverse * last.scatter * inverse;
  if (!covariance.allFinite() || covariance.diagonal().minCoeff() < 0.0) return std::nullopt;
  const Vector4d sigma = covariance.diagonal().cwiseSqrt();
  out.mu_in = x(0);
  out.mu_out = x(1);
  out.delta_m = x(2);
  out.sigma_m = x(3);
  out.mu_in_sigma = sigma(0);
  out.mu_out_sigma = sigma(1);
  out.delta_sigma_m = sigma(2);
  out.sigma_sigma_m = sigma(3);
  const auto final_levels = levels_of(points, out.delta_m, out.sigma_m);
  if (!final_levels) return std::nullopt;
  out.noise =
      std::sqrt(0.5 * (std::pow(final_levels->noise_in, 2) + std::pow(final_levels->noise_out, 2)));
  return out;
}

}  // namespace lvcalib
