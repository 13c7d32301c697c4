// SPDX-License-Identifier: BSD-3-Clause
#include "response/transition_spread.h"

#include <algorithm>
#include <cmath>

#include "base/statistics.h"

namespace lvcalib {
namespace {

// Plateaus begin this many σ from the edge, but keep this share of what lies on their side.
constexpr double kPlateau = 2.0;
constexpr double kKept = 0.4;
constexpr std::size_t kFewestForSpread = 10;
constexpr double kStray = 6.0;  // Standard deviations beyond a level.

}  // namespace

bool PlateauLevels::is_stray(double intensity) const {
  const bool rises = out >= in;
  const double low = rises ? in - kStray * noise_in : out - kStray * noise_out;
  const double high = rises ? out + kStray * noise_out : in + kStray * noise_in;
  // Without noise a rounding must not count as a stray.
  const double slack = 0.02 * std::abs(out - in);
  return !(intensity >= low - slack && intensity <= high + slack);
}

bool PlateauLevels::stand_clear() const {
  return std::abs(out - in) > std::max(noise_in, noise_out);
}

std::optional<PlateauLevels> plateau_levels(const std::vector<std::pair<double, double>>& samples) {
  std::vector<double> in;
  std::vector<double> out;
  double lowest = 0.0;
  double highest = 0.0;
  for (const auto& [z, intensity] : samples) {
    lowest = std::min(lowest, z);
    highest = std::max(highest, z);
  }
  const double clear_in = std::max(-kPlateau, (1.0 - kKept) * lowest);
  const double clear_out = std::min(kPlateau, (1.0 - kKept) * highest);
  for (const auto& [z, intensity] : samples) {
    if (z < clear_in) in.push_back(intensity);
    if (z > clear_out) out.push_back(intensity);
  }
  if (in.size() < kFewestForSpread || out.size() < kFewestForSpread) return std::nullopt;
  PlateauLevels levels;
  levels.noise_in = mad_sigma(in);
  levels.noise_out = mad_sigma(out);
  levels.in = median(std::move(in));
  levels.out = median(std::move(out));
  return levels;
}

namespace {

double noise_variance(double lambda, const PlateauLevels& levels) {
  const double floor = 1e-3 * (levels.out - levels.in);
  return (1.0 - lambda) * levels.noise_in * levels.noise_in +
         lambda * levels.noise_out * levels.noise_out + floor * floor;
}

double mixing_variance(double lambda, const PlateauLevels& levels) {
  const double contrast = levels.out - levels.in;
  return contrast * contrast * lambda * (1.0 - lambda);
}

}  // namespace

void TransitionSpread::clear() {
  excess_ = mixing_ = 0.0;
}

void TransitionSpread::add(double lambda, double residual, const PlateauLevels& levels) {
  excess_ += residual * residual - noise_variance(lambda, levels);
  mixing_ += mixing_variance(lambda, levels);
}

void TransitionSpread::finish() {
  if (mixing_ > 0.0) share_ = std::clamp(excess_ / mixing_, 1e-3, 1.0);
}

double TransitionSpread::variance(double lambda, const PlateauLevels& levels) const {
  return noise_variance(lambda, levels) + share_ * mixing_variance(lambda, levels);
}

}  // namespace lvcalib
