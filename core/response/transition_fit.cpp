// SPDX-License-Identifier: BSD-3-Clause
#include "response/transition_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

#include "base/statistics.h"

namespace lvcalib {
namespace {

constexpr std::size_t kFewest = 20;
constexpr double kPlateau = 2.0;  // Plateaus begin this many σ from the edge.

struct Levels {
  double in = 0.0, out = 0.0, noise_in = 0.0, noise_out = 0.0;
};

std::optional<Levels> levels_of(std::span<const TransitionPoint> points, double delta_m,
                                double sigma_m) {
  std::vector<double> in;
  std::vector<double> out;
  for (const TransitionPoint& p : points) {
    if (p.distance_m - delta_m < -kPlateau * sigma_m) in.push_back(p.intensity);
    if (p.distance_m - delta_m > kPlateau * sigma_m) out.push_back(p.intensity);
  }
  if (in.size() < kFewest / 2 || out.size() < kFewest / 2) return std::nullopt;
  Levels levels;
  levels.noise_in = mad_sigma(in);
  levels.noise_out = mad_sigma(out);
  levels.in = median(std::move(in));
  levels.out = median(std::move(out));
  return levels;
}

using Vector4d = Eigen::Matrix<double, 4, 1>;
using Matrix4d = Eigen::Matrix<double, 4, 4>;

struct System {
  Matrix4d normal = Matrix4d::Zero();
  Matrix4d scatter = Matrix4d::Zero();  // Σ w² r² J Jᵀ
  Vector4d rhs = Vector4d::Zero();
  int used = 0;
};

// Parameters: μ_in, μ_out, δ, σ. A sample's spread follows its place: plateau noise, and within
// the transition what moving footprints add.
class Fit {
 public:
  Fit(std::span<const TransitionPoint> points, const Vector4d& start)
      : points_(points), x_(start) {}

  bool run() {
    constexpr int kIterations = 25;
    for (int i = 0; i < kIterations; ++i) {
      if (i < 6) measure_spread();
      const System s = system();
      if (s.used < static_cast<int>(kFewest)) return false;
      const Eigen::LDLT<Matrix4d> factor(s.normal);
      if (factor.info() != Eigen::Success) return false;
      Vector4d step = factor.solve(s.rhs);
      if (!step.allFinite()) return false;
      // Width and place move by at most half a width at a time.
      const double limit = 0.5 * x_(3);
      const double longest = std::max(std::abs(step(2)), std::abs(step(3)));
      if (longest > limit) step *= limit / longest;
      x_ += step;
      if (i >= 6 && std::max(std::abs(step(2)), std::abs(step(3))) < 1e-4 * x_(3)) break;
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
  static constexpr int kZones = 9;
  [[nodiscard]] static std::size_t zone(double z) {
    return static_cast<std::size_t>(
        std::clamp(static_cast<int>(std::floor(z + 4.5)), 0, kZones - 1));
  }

  void measure_spread() {
    std::array<std::vector<double>, kZones> residuals;
    for (const TransitionPoint& p : points_) {
      const double z = (p.distance_m - x_(2)) / x_(3);
      residuals[zone(z)].push_back(p.intensity - value(z));
    }
    const double floor = 1e-3 * std::abs(x_(1) - x_(0));
    for (std::size_t k = 0; k < residuals.size(); ++k) {
      const bool enough = residuals[k].size() >= 10;
      // Root mean square about zero by the median: robust, and right for a symmetric spread.
      for (double& r : residuals[k]) r = std::abs(r);
      spread_[k] =
          std::max(floor, enough ? 1.4826 * median(std::move(residuals[k])) : 10.0 * floor);
    }
  }

  [[nodiscard]] double value(double z) const { return x_(0) + (x_(1) - x_(0)) * normal_cdf(z); }

  [[nodiscard]] System system() const {
    System s;
    for (const TransitionPoint& p : points_) {
      const double z = (p.distance_m - x_(2)) / x_(3);
      const double lambda = normal_cdf(z);
      const double r = p.intensity - (x_(0) + (x_(1) - x_(0)) * lambda);
      const double spread = spread_[zone(z)];
      const double weight = tukey_weight(r / spread, 6.0) / (spread * spread);
      if (weight <= 0.0) continue;
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
  Vector4d x_;
  std::array<double, kZones> spread_{};
};

}  // namespace

std::optional<TransitionFit> fit_transition(std::span<const TransitionPoint> points,
                                            double sigma_start_m) {
  if (points.size() < kFewest || !(sigma_start_m > 0.0)) return std::nullopt;
  const auto levels = levels_of(points, 0.0, sigma_start_m);
  if (!levels ||
      !(std::abs(levels->out - levels->in) > std::max(levels->noise_in, levels->noise_out)))
    return std::nullopt;
  Fit fit(points, {levels->in, levels->out, 0.0, sigma_start_m});
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
