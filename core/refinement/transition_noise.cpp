// SPDX-License-Identifier: BSD-3-Clause
#include "refinement/transition_noise.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "base/statistics.h"

namespace lvcalib {
namespace {

// Noise as a beam has it: that of the two plateaus, mixed like their levels, and that of a beam
// whose direction jitters: in proportion to the square of the profile's slope.
struct NoiseShape {
  double inner = 0.0;
  double outer = 0.0;
  double jitter = 0.0;
  [[nodiscard]] double plateaus(double z) const { return inner + (outer - inner) * normal_cdf(z); }
  [[nodiscard]] double variance(double z) const {
    return plateaus(z) + jitter * normal_pdf(z) * normal_pdf(z);
  }
};

double mean_of(const std::vector<double>& values, double fallback) {
  if (values.empty()) return fallback;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// From the squared residuals of the zones whose middles are given; plateaus first and last.
NoiseShape fit_noise_shape(std::span<const std::vector<double>> squares,
                           std::span<const double> middles) {
  NoiseShape shape;
  shape.outer = mean_of(squares.back(), mean_of(squares.front(), 0.0));
  shape.inner = mean_of(squares.front(), shape.outer);
  double sum = 0.0;
  double norm = 0.0;
  for (std::size_t k = 1; k + 1 < squares.size(); ++k) {
    const double slope_sq = normal_pdf(middles[k]) * normal_pdf(middles[k]);
    for (const double square : squares[k]) sum += slope_sq * (square - shape.plateaus(middles[k]));
    norm += static_cast<double>(squares[k].size()) * slope_sq * slope_sq;
  }
  if (norm > 0.0) shape.jitter = std::max(0.0, sum / norm);
  return shape;
}

// Without what is far beyond a plateau's noise: strays (a tag's edge, another surface).
void remove_strays(std::vector<double>& plateau) {
  constexpr double kOutlier = 5.0;            // Standard deviations, as everywhere.
  constexpr double kMedianOfSquare = 0.4549;  // Of χ² with one degree of freedom.
  if (plateau.empty()) return;
  const double cut = kOutlier * kOutlier * median(plateau) / kMedianOfSquare;
  std::erase_if(plateau, [&](double square) { return square > cut; });
}

}  // namespace

std::size_t TransitionNoise::zone(double z) {
  const double k = std::floor(z / kZoneWidth) + 0.5 * kZones;
  return static_cast<std::size_t>(std::clamp(k, 0.0, kZones - 1.0));
}

double TransitionNoise::plateau_sigma() const {
  return std::sqrt(std::max(variance_.front(), variance_.back()));
}

void TransitionNoise::update(const std::vector<TransitionResidual>& residuals) {
  constexpr std::size_t kFewest = 20;  // These tell a variance to √(2/20), a third.
  if (residuals.size() < kFewest) return;
  std::array<std::vector<double>, kZones> squares;
  for (const TransitionResidual& r : residuals) squares[zone(r.z)].push_back(r.square);
  // Between the plateaus nothing is a stray: a beam that jitters jumps from one to the other.
  remove_strays(squares.front());
  remove_strays(squares.back());
  std::array<double, kZones> middles{};
  for (std::size_t k = 0; k < kZones; ++k)
    middles[k] = (static_cast<double>(k) - 0.5 * kZones + 0.5) * kZoneWidth;
  const NoiseShape shape = fit_noise_shape(squares, middles);
  for (std::size_t k = 0; k < kZones; ++k) {
    // The shape stands in for ten more samples, so that thin zones stay near it.
    constexpr double kPrior = 10.0;
    const double prior = shape.variance(middles[k]);
    const double sum = std::accumulate(squares[k].begin(), squares[k].end(), kPrior * prior);
    // A quantised, noiseless level must not get infinite weight.
    variance_[k] = std::max(sum / (kPrior + static_cast<double>(squares[k].size())), 1e-6);
  }
}

}  // namespace lvcalib
