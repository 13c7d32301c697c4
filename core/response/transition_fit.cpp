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

constexpr std::size_t kFewestForFit = 20;

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

// Weighted least squares of the mean level. A jittering beam makes levels in the transition jump
// between black and white, skewed on either side: any loss that favours the bulk would be pulled
// to the nearer level. So all samples between the levels count by their squares, weighed by the
// mean square at their place; only what no mixture of black and white gives is left out.
class TransitionFitter {
 public:
  TransitionFitter(std::span<const TransitionPoint> points, const Levels& levels, double sigma_m)
      : points_(points), levels_(levels), x_(levels.in, levels.out, 0.0, sigma_m) {}

  bool run() {
    constexpr int kIterations = 30;
    constexpr int kSpreadRounds = 8;
    constexpr int kFewestRounds = 4;
    constexpr double kSettled = 1e-4;
    for (int i = 0; i < kIterations; ++i) {
      if (i < kSpreadRounds) measure_spread();
      const System s = system();
      if (s.used < static_cast<int>(kFewestForFit)) return false;
      const Eigen::LDLT<Matrix4d> factor(s.normal);
      if (factor.info() != Eigen::Success) return false;
      Vector4d step = factor.solve(s.rhs);
      if (!step.allFinite()) return false;
      // Width and place move by at most half a width at a time.
      const double limit = 0.5 * x_(3);
      const double longest = std::max(std::abs(step(2)), std::abs(step(3)));
      if (longest > limit) step *= limit / longest;
      x_ += step;
      if (i >= kFewestRounds && longest < kSettled * x_(3)) break;
    }
    return x_.allFinite() && x_(3) > 0.0;
  }

  [[nodiscard]] const Vector4d& x() const { return x_; }

  // H⁻¹ (Σ w² r² J Jᵀ) H⁻¹
  Matrix4d covariance(int& used) const {
    const System s = system();
    used = s.used;
    const Matrix4d inverse = s.normal.ldlt().solve(Matrix4d::Identity());
    return inverse * s.scatter * inverse;
  }

 private:
  [[nodiscard]] double value(double z) const { return x_(0) + (x_(1) - x_(0)) * normal_cdf(z); }

  void measure_spread() {
    spread_.clear();
    for (const TransitionPoint& p : points_) {
      if (levels_.is_stray(p.intensity)) continue;
      const double z = (p.distance_m - x_(2)) / x_(3);
      spread_.add(normal_cdf(z), p.intensity - value(z), levels_);
    }
    spread_.finish();
  }

  [[nodiscard]] System system() const {
    System s;
    for (const TransitionPoint& p : points_) {
      if (levels_.is_stray(p.intensity)) continue;
      const double z = (p.distance_m - x_(2)) / x_(3);
      const double lambda = normal_cdf(z);
      const double r = p.intensity - (x_(0) + (x_(1) - x_(0)) * lambda);
      const double weight = 1.0 / spread_.variance(lambda, levels_);
      const double slope = (x_(1) - x_(0)) * normal_pdf(z) / x_(3);
      const Vector4d j(1.0 - lambda, lambda, -slope, -slope * z);
      s.normal += weight * j * j.transpose();
      s.scatter += weight * weight * r * r * j * j.transpose();
      s.rhs += weight * r * j;
      ++s.used;
    }
    return s;
  }

  std::span<const TransitionPoint> points_;
  const Levels& levels_;
  Vector4d x_;
  TransitionSpread spread_;
};

}  // namespace

std::optional<TransitionFit> fit_transition(std::span<const TransitionPoint> points,
                                            double sigma_start_m) {
  if (points.size() < kFewestForFit || !(sigma_start_m > 0.0)) return std::nullopt;
  const auto levels = levels_of(points, 0.0, sigma_start_m);
  if (!levels || !levels->stand_clear()) return std::nullopt;
  TransitionFitter fit(points, *levels, sigma_start_m);
  if (!fit.run()) return std::nullopt;
  TransitionFit out;
  const Matrix4d covariance = fit.covariance(out.samples);
  if (!covariance.allFinite() || covariance.diagonal().minCoeff() < 0.0) return std::nullopt;
  const Vector4d sigma = covariance.diagonal().cwiseSqrt();
  out.mu_in = fit.x()(0);
  out.mu_out = fit.x()(1);
  out.delta_m = fit.x()(2);
  out.sigma_m = fit.x()(3);
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
