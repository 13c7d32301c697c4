// SPDX-License-Identifier: BSD-3-Clause
#include "refinement/transition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/Cholesky>

#include "base/statistics.h"
#include "base/symmetric.h"

namespace lvcalib {
namespace {

// Levels this many standard deviations beyond a plateau are someone else's (a stray hit).
constexpr double kOutlier = 5.0;

}  // namespace

TransitionModel::TransitionModel(double sigma_m)
    : footprint_(sigma_m * sigma_m * Eigen::Matrix2d::Identity()) {}

double TransitionModel::sigma_m(const UnwrappedSample& s) const {
  const Eigen::Vector2d e(s.cos_psi, s.sin_psi);
  return std::sqrt(e.dot(footprint_ * e));
}

double TransitionModel::mean_sigma_m() const {
  return std::sqrt(0.5 * footprint_.trace());
}

double TransitionModel::leverage(const UnwrappedSample& s, double distance_variance_m2) const {
  const double sigma = sigma_m(s);
  const double z = s.distance_m / sigma;
  const double slope = normal_pdf(z) / sigma;
  // A fit of a few unknowns to a ring of samples holds no sample by more than half.
  return std::min(0.5, slope * slope * distance_variance_m2 / noise_.variance(z));
}

void TransitionModel::update(const std::vector<UnwrappedSample>& samples, double min_sigma_m,
                             double max_sigma_m) {
  update_footprint(samples, min_sigma_m, max_sigma_m);
  update_noise(samples);
}

void TransitionModel::update_footprint(const std::vector<UnwrappedSample>& samples,
                                       double min_sigma_m, double max_sigma_m) {
  constexpr int kIterations = 6;
  for (int i = 0; i < kIterations; ++i) {
    // level = Φ(d/σ): ∂/∂σ² = −φ(d/σ)·d/(2σ³); σ² is linear in the three entries of S.
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d rhs = Eigen::Vector3d::Zero();
    for (const UnwrappedSample& s : samples) {
      const double sigma = sigma_m(s);
      const double z = s.distance_m / sigma;
      if (std::abs(z) > 4.0) continue;
      const double e = s.level - normal_cdf(z);
      const double v = noise_.variance(z);
      if (is_stray(s.level)) continue;
      const double by_variance = -normal_pdf(z) * z / (2.0 * sigma * sigma);
      const Eigen::Vector3d j =
          by_variance * Eigen::Vector3d(s.cos_psi * s.cos_psi, 2.0 * s.cos_psi * s.sin_psi,
                                        s.sin_psi * s.sin_psi);
      normal += j * j.transpose() / v;
      rhs += j * e / v;
    }
    normal.diagonal() *= 1.0 + 1e-6;
    const Eigen::Vector3d step = normal.ldlt().solve(rhs);
    if (!step.allFinite()) return;
    Eigen::Matrix2d next;
    next << footprint_(0, 0) + step(0), footprint_(0, 1) + step(1), footprint_(0, 1) + step(1),
        footprint_(1, 1) + step(2);
    // Keep the ellipse within believable axes.
    const auto axes = axes_of(next);
    const Eigen::Vector2d bounded =
        axes.values.cwiseMax(min_sigma_m * min_sigma_m).cwiseMin(max_sigma_m * max_sigma_m);
    const Eigen::Matrix2d kept = axes.vectors * bounded.asDiagonal() * axes.vectors.transpose();
    const double change = (kept - footprint_).norm() / footprint_.norm();
    footprint_ = kept;
    if (change < 1e-3) break;
  }
}

bool TransitionModel::is_stray(double level) const {
  const double slack = 0.02 + kOutlier * noise_.plateau_sigma();
  return !(level >= -slack && level <= 1.0 + slack);
}

void TransitionModel::update_noise(const std::vector<UnwrappedSample>& samples) {
  std::vector<TransitionResidual> residuals;
  residuals.reserve(samples.size());
  for (const UnwrappedSample& s : samples) {
    const double z = s.distance_m / sigma_m(s);
    const double e = s.level - normal_cdf(z);
    // What the circle's own fit took from the residual is given back.
    residuals.push_back({z, e * e / (1.0 - s.leverage)});
  }
  noise_.update(residuals);
}

namespace {

// Crossing of the mid-level in the binned radial profile, as a start for the exact solution.
double interpolate_crossing(const std::vector<UnwrappedSample>& samples, double low, double high) {
  constexpr int kSlots = 10;
  std::array<double, kSlots> sum{};
  std::array<double, kSlots> count{};
  for (const UnwrappedSample& s : samples) {
    const int k = static_cast<int>((s.distance_m - low) / (high - low) * kSlots);
    if (k < 0 || k >= kSlots) continue;
    sum[static_cast<std::size_t>(k)] += s.level;
    count[static_cast<std::size_t>(k)] += 1.0;
  }
  double previous_d = low;
  double previous_level = 0.0;
  for (std::size_t k = 0; k < kSlots; ++k) {
    if (count[k] == 0) continue;
    const double d = low + (static_cast<double>(k) + 0.5) * (high - low) / kSlots;
    const double level = sum[k] / count[k];
    if (level >= 0.5 && previous_level < 0.5) {
      return previous_d + (d - previous_d) * (0.5 - previous_level) / (level - previous_level);
    }
    previous_d = d;
    previous_level = level;
  }
  return 0.0;
}

struct CrossingSystem {
  double information = 0.0;
  double rhs = 0.0;
  double cos_sum = 0.0, sin_sum = 0.0;
  int near_inside = 0, near_outside = 0;
};

CrossingSystem crossing_system(const std::vector<UnwrappedSample>& samples,
                               const TransitionModel& model, double crossing) {
  CrossingSystem system;
  for (const UnwrappedSample& s : samples) {
    const double sigma = model.sigma_m(s);
    const double z = (s.distance_m - crossing) / sigma;
    if (std::abs(z) > 4.0) continue;
    const double e = s.level - normal_cdf(z);
    const double v = model.noise().variance(z);
    if (model.is_stray(s.level)) continue;
    const double j = -normal_pdf(z) / sigma;  // ∂level/∂crossing
    const double information = j * j / v;
    system.information += information;
    system.rhs += j * e / v;
    system.cos_sum += information * s.cos_psi;
    system.sin_sum += information * s.sin_psi;
    if (z < 0.5) ++system.near_inside;
    if (z > -0.5) ++system.near_outside;
  }
  return system;
}

}  // namespace

void solve_crossing(const std::vector<UnwrappedSample>& samples, const TransitionModel& model,
                    double window_in_m, double window_out_m, int min_samples, BinRecord& bin) {
  constexpr int kIterations = 12;
  bin.samples = static_cast<int>(samples.size());
  if (bin.samples < min_samples) {
    bin.state = BinState::kTooFewSamples;
    return;
  }
  double crossing = interpolate_crossing(samples, -window_in_m, window_out_m);
  const double step_limit = model.mean_sigma_m();
  CrossingSystem system;
  for (int i = 0; i < kIterations; ++i) {
    system = crossing_system(samples, model, crossing);
    if (system.information <= 0) break;
    const double step = std::clamp(system.rhs / system.information, -step_limit, step_limit);
    crossing += step;
    if (std::abs(step) < 1e-7) break;
  }
  if (system.information <= 0 || crossing < -window_in_m || crossing > window_out_m) {
    bin.state = BinState::kNoCrossing;
    return;
  }
  if (system.near_inside == 0 || system.near_outside == 0) {
    bin.state = BinState::kOneSided;
    return;
  }
  bin.midpoint_m = crossing;
  bin.sigma_m = 1.0 / std::sqrt(system.information);
  bin.angle_rad = std::atan2(system.sin_sum, system.cos_sum);
  // A midpoint known no better than the window is no measurement.
  bin.state =
      bin.sigma_m < 0.25 * (window_in_m + window_out_m) ? BinState::kUsed : BinState::kNoCrossing;
}

void step_crossing(const std::vector<UnwrappedSample>& samples, const TransitionModel& model,
                   double expected_m, BinRecord& bin) {
  const CrossingSystem system = crossing_system(samples, model, expected_m);
  if (system.information <= 0) return;
  bin.midpoint_m = expected_m + system.rhs / system.information;
  bin.sigma_m = 1.0 / std::sqrt(system.information);
  bin.angle_rad = std::atan2(system.sin_sum, system.cos_sum);
}

namespace {

// The profile of a bin: medians of distance and level in slots of equal width, from inside out.
std::vector<Eigen::Vector2d> median_profile(const std::vector<UnwrappedSample>& samples,
                                            const MidpointWindow& window) {
  constexpr std::size_t kProfileSlots = 10;
  std::array<std::vector<double>, kProfileSlots> distances;
  std::array<std::vector<double>, kProfileSlots> levels;
  const double width = (window.inside_m + window.outside_m) / kProfileSlots;
  for (const UnwrappedSample& s : samples) {
    const double k = std::floor((s.distance_m + window.inside_m) / width);
    if (!(k >= 0.0 && k < static_cast<double>(kProfileSlots))) continue;
    distances[static_cast<std::size_t>(k)].push_back(s.distance_m);
    levels[static_cast<std::size_t>(k)].push_back(s.level);
  }
  std::vector<Eigen::Vector2d> profile;
  for (std::size_t k = 0; k < kProfileSlots; ++k) {
    if (!levels[k].empty()) profile.emplace_back(median(distances[k]), median(levels[k]));
  }
  return profile;
}

// Where a profile rises through a level; of several such places the one nearest to the circle.
std::optional<double> nearest_rise(const std::vector<Eigen::Vector2d>& profile, double level) {
  std::optional<double> nearest;
  for (std::size_t k = 1; k < profile.size(); ++k) {
    const Eigen::Vector2d& a = profile[k - 1];
    const Eigen::Vector2d& b = profile[k];
    if (!(a.y() < level && b.y() >= level)) continue;
    const double d = a.x() + (b.x() - a.x()) * (level - a.y()) / (b.y() - a.y());
    if (!nearest || std::abs(d) < std::abs(*nearest)) nearest = d;
  }
  return nearest;
}

}  // namespace

void interpolate_midpoint(const std::vector<UnwrappedSample>& samples, const MidpointWindow& window,
                          int min_samples, double min_contrast, BinRecord& bin) {
  bin.samples = static_cast<int>(samples.size());
  if (bin.samples < min_samples) {
    bin.state = BinState::kTooFewSamples;
    return;
  }
  std::vector<double> inner;
  std::vector<double> outer;
  for (const UnwrappedSample& s : samples) {
    if (s.distance_m < -window.clear_inside_m) inner.push_back(s.level);
    if (s.distance_m > window.clear_outside_m) outer.push_back(s.level);
  }
  // A median of one is no median.
  if (inner.size() < 2 || outer.size() < 2) {
    bin.state = BinState::kOneSided;
    return;
  }
  const double noise = std::max(mad_sigma(inner), mad_sigma(outer));
  const double black = median(std::move(inner));
  const double contrast = median(std::move(outer)) - black;
  if (!(contrast > 0.0) || contrast < min_contrast * noise) {
    bin.state = BinState::kWeakContrast;
    return;
  }
  const auto crossing = nearest_rise(median_profile(samples, window), black + 0.5 * contrast);
  if (!crossing) {
    bin.state = BinState::kNoCrossing;
    return;
  }
  bin.midpoint_m = *crossing;
  bin.sigma_m = 1.0 / std::sqrt(contrast * bin.samples);
  bin.state = BinState::kUsed;
}

}  // namespace lvcalib
