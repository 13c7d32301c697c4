// SPDX-License-Identifier: BSD-3-Clause
#include "refinement/node_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>

#include "base/statistics.h"

namespace lvcalib {
namespace {

// Least samples for a median level worth the name.
constexpr std::size_t kMinLevelSamples = 8;
// Steps from the wave's crossings; the second moves by the square of what the first did.
constexpr int kSteps = 2;

int choose_bin_count(std::size_t samples, const RefinementOptions& options) {
  const int wanted = static_cast<int>(static_cast<double>(samples) / options.samples_per_bin);
  return std::clamp(wanted, options.min_bins, options.max_bins);
}

// Weighted least squares of d* = Δc_u cos ψ + Δc_v sin ψ + Δr over the used bins.
bool solve_wave(NodeFit& fit) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d rhs = Eigen::Vector3d::Zero();
  int used = 0;
  for (const BinRecord& bin : fit.record.bins) {
    if (bin.state != BinState::kUsed) continue;
    const Eigen::Vector3d j(std::cos(bin.angle_rad), std::sin(bin.angle_rad), 1.0);
    const double weight = 1.0 / (bin.sigma_m * bin.sigma_m);
    normal += weight * j * j.transpose();
    rhs += weight * bin.midpoint_m * j;
    ++used;
  }
  fit.degrees_of_freedom = used - 3;
  const Eigen::LDLT<Eigen::Matrix3d> factor(normal);
  // Three unknowns need at least four midpoints spread over the circle.
  if (used < 4 || factor.info() != Eigen::Success || factor.rcond() < 1e-6) return false;
  fit.record.wave_m = factor.solve(rhs);
  fit.covariance_m2 = factor.solve(Eigen::Matrix3d::Identity());
  fit.chi_square = 0.0;
  for (const BinRecord& bin : fit.record.bins) {
    if (bin.state != BinState::kUsed) continue;
    const Eigen::Vector3d j(std::cos(bin.angle_rad), std::sin(bin.angle_rad), 1.0);
    const double r = (bin.midpoint_m - j.dot(fit.record.wave_m)) / bin.sigma_m;
    fit.chi_square += r * r;
  }
  return fit.record.wave_m.allFinite();
}

// Refuses the bin that contradicts the wave most, if it does so clearly. True if one was refused.
bool refuse_worst_bin(NodeFit& fit) {
  // One chance in ten thousand per bin, widened when all bins scatter more than they claim.
  constexpr double kGate = 4.0;
  const double excess =
      fit.degrees_of_freedom > 0 ? std::max(1.0, fit.chi_square / fit.degrees_of_freedom) : 1.0;
  BinRecord* worst = nullptr;
  double worst_ratio = kGate * std::sqrt(excess);
  for (BinRecord& bin : fit.record.bins) {
    if (bin.state != BinState::kUsed) continue;
    const Eigen::Vector3d j(std::cos(bin.angle_rad), std::sin(bin.angle_rad), 1.0);
    const double ratio = std::abs(bin.midpoint_m - j.dot(fit.record.wave_m)) / bin.sigma_m;
    if (ratio > worst_ratio) {
      worst_ratio = ratio;
      worst = &bin;
    }
  }
  if (worst == nullptr) return false;
  worst->state = BinState::kOutlier;
  return true;
}

// A bin's own crossing is as uncertain as its few samples; the wave is surer. Stepping from there
// makes the midpoints linear in the noise: as precise as all samples together allow.
void step_crossings(const std::vector<std::vector<UnwrappedSample>>& by_bin,
                    const TransitionModel& model, NodeFit& fit) {
  for (std::size_t k = 0; k < by_bin.size(); ++k) {
    BinRecord& bin = fit.record.bins[k];
    if (bin.state != BinState::kUsed) continue;
    const Eigen::Vector3d j(std::cos(bin.angle_rad), std::sin(bin.angle_rad), 1.0);
    step_crossing(by_bin[k], model, j.dot(fit.record.wave_m), bin);
  }
}

using BinnedSamples = std::vector<std::vector<UnwrappedSample>>;

// Parts the samples by their angle and makes a record for every bin.
BinnedSamples part_by_angle(const std::vector<UnwrappedSample>& samples,
                            const RefinementOptions& options, NodeFit& fit) {
  const int bins = choose_bin_count(samples.size(), options);
  fit.record.bins.resize(static_cast<std::size_t>(bins));
  BinnedSamples by_bin(fit.record.bins.size());
  const double width = 2.0 * std::numbers::pi / bins;
  for (UnwrappedSample s : samples) {
    const double psi = std::atan2(s.sin_psi, s.cos_psi);
    s.bin = std::clamp(static_cast<int>((psi + std::numbers::pi) / width), 0, bins - 1);
    by_bin[static_cast<std::size_t>(s.bin)].push_back(s);
  }
  for (std::size_t k = 0; k < by_bin.size(); ++k) {
    fit.record.bins[k].angle_rad = -std::numbers::pi + (static_cast<double>(k) + 0.5) * width;
  }
  return by_bin;
}

// Where the plateaus of a window begin: two standard deviations of the transition from the edge,
// but so that half of the window is left.
MidpointWindow plateaus_of(const NodeWindow& window, double transition_sigma_m) {
  return {window.inside_m, window.outside_m,
          std::min(2.0 * transition_sigma_m, 0.5 * window.inside_m),
          std::min(2.0 * transition_sigma_m, 0.5 * window.outside_m)};
}

// The bins as the paper has them, and their wave. What the midpoints scatter about it tells the
// unit of their weights.
NodeFit fit_midpoints(const std::vector<UnwrappedSample>& samples, NodeRecord record,
                      const MidpointWindow& window, const RefinementOptions& options) {
  // Midpoints that scatter not at all still have a standard deviation.
  constexpr double kLeastUnit_m = 1e-6;
  NodeFit fit;
  fit.record = std::move(record);
  const BinnedSamples by_bin = part_by_angle(samples, options, fit);
  for (std::size_t k = 0; k < by_bin.size(); ++k) {
    interpolate_midpoint(by_bin[k], window, options.min_bin_samples, options.min_contrast,
                         fit.record.bins[k]);
  }
  if (!solve_wave(fit)) {
    fit.record.reason = Message("too few usable bins around the circle");
    return fit;
  }
  const double unit_m = std::max(kLeastUnit_m, std::sqrt(fit.chi_square / fit.degrees_of_freedom));
  for (BinRecord& bin : fit.record.bins) {
    if (bin.state != BinState::kUsed) continue;
    fit.weight += 1.0 / (bin.sigma_m * bin.sigma_m);
    bin.sigma_m *= unit_m;
  }
  fit.covariance_m2 *= unit_m * unit_m;
  fit.chi_square /= unit_m * unit_m;
  fit.record.valid = true;
  return fit;
}

}  // namespace

NodeWindow node_window(const Target& target) {
  NodeWindow window;
  window.radius_m = target.circle_radius_m;
  // To the centre of the circle, less what the polar angle needs to be defined.
  window.inside_m = 0.9 * target.circle_radius_m;
  // To the nearest tag corner, along the diagonal of the gap crossing.
  window.outside_m =
      0.5 * target.tag_spacing * target.tag_size_m * std::numbers::sqrt2 - target.circle_radius_m;
  return window;
}

std::vector<UnwrappedSample> unwrap_node(const std::vector<PlaneSample>& samples,
                                         const Eigen::Vector2d& center_uv_m,
                                         const NodeWindow& window, double transition_sigma_m,
                                         NodeRecord& record) {
  record.center_uv_m = center_uv_m;
  std::vector<UnwrappedSample> out;
  std::vector<double> inner;
  std::vector<double> outer;
  const MidpointWindow plateaus = plateaus_of(window, transition_sigma_m);
  const double largest = window.radius_m + window.outside_m;
  for (const PlaneSample& sample : samples) {
    const Eigen::Vector2d d = sample.uv_m - center_uv_m;
    const double radius_sq = d.squaredNorm();
    if (radius_sq > largest * largest) continue;
    const double radius = std::sqrt(radius_sq);
    const double distance = radius - window.radius_m;
    if (distance < -plateaus.clear_inside_m) inner.push_back(sample.intensity);
    if (distance > plateaus.clear_outside_m) outer.push_back(sample.intensity);
    if (distance < -window.inside_m) continue;
    out.push_back({d.x() / radius, d.y() / radius, distance, sample.intensity, 0});
  }
  if (inner.size() < kMinLevelSamples || outer.size() < kMinLevelSamples) {
    record.reason =
        Message("too few samples: %1 inside and %2 outside the circle, at least %3 each needed",
                inner.size(), outer.size(), kMinLevelSamples);
    return {};
  }
  const double noise = std::max(mad_sigma(inner), mad_sigma(outer));
  record.inner_level = median(std::move(inner));
  record.outer_level = median(std::move(outer));
  const double contrast = record.outer_level - record.inner_level;
  if (!(contrast > noise) || contrast <= 0) {
    record.reason = Message("no contrast between circle and paper");
    return {};
  }
  for (UnwrappedSample& s : out) s.level = (s.level - record.inner_level) / contrast;
  return out;
}

NodeFit fit_node(const std::vector<UnwrappedSample>& samples, NodeRecord record,
                 const NodeWindow& window, const TransitionModel& model,
                 const RefinementOptions& options) {
  if (options.estimator == CenterEstimator::kMidpoint) {
    return fit_midpoints(samples, std::move(record), plateaus_of(window, model.mean_sigma_m()),
                         options);
  }
  NodeFit fit;
  fit.record = std::move(record);
  const BinnedSamples by_bin = part_by_angle(samples, options, fit);
  const double plateau_noise = model.noise().plateau_sigma();
  const bool weak = plateau_noise * options.min_contrast > 1.0;
  for (std::size_t k = 0; k < by_bin.size(); ++k) {
    BinRecord& bin = fit.record.bins[k];
    solve_crossing(by_bin[k], model, window.inside_m, window.outside_m, options.min_bin_samples,
                   bin);
    if (weak && bin.state == BinState::kUsed) bin.state = BinState::kWeakContrast;
  }
  bool solved = solve_wave(fit);
  while (solved && refuse_worst_bin(fit)) solved = solve_wave(fit);
  for (int i = 0; solved && i < kSteps; ++i) {
    step_crossings(by_bin, model, fit);
    solved = solve_wave(fit);
  }
  if (!solved) {
    fit.record.reason = Message("too few usable bins around the circle");
    return fit;
  }
  // A centre known no better than a quarter of the radius is no measurement.
  const double variance = fit.covariance_m2.topLeftCorner<2, 2>().trace();
  fit.weight = 1.0 / variance;
  const double sigma = std::sqrt(variance);
  fit.record.valid = sigma < 0.25 * window.radius_m;
  if (!fit.record.valid) fit.record.reason = Message("centre too uncertain");
  return fit;
}

}  // namespace lvcalib
