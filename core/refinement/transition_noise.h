// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

namespace lvcalib {

/// A sample's squared residual of the level at z = d/σ in the transition.
struct TransitionResidual {
  double z = 0.0;
  double square = 0.0;
};

/// How the noise of an intensity sample, over the level difference, depends on its place in the
/// transition across a circle's edge: between the plateaus a beam that jitters moves along the
/// profile, and what has not been modelled shows.
class TransitionNoise {
 public:
  /// The same everywhere, until more is known.
  TransitionNoise() { variance_.fill(kUnknown); }

  /// Variance of a sample's level at z = d/σ.
  [[nodiscard]] double variance(double z) const { return variance_[zone(z)]; }
  /// The larger of the two plateaus' standard deviations.
  [[nodiscard]] double plateau_sigma() const;

  /// Estimates it anew; fewer than twenty residuals change nothing.
  void update(const std::vector<TransitionResidual>& residuals);

 private:
  // The transition is divided at z = −3, −2.5, …, 3, with the plateaus at both ends.
  static constexpr std::size_t kZones = 14;
  static constexpr double kZoneWidth = 0.5;
  static constexpr double kUnknown = 0.05;
  [[nodiscard]] static std::size_t zone(double z);

  std::array<double, kZones> variance_{};
};

}  // namespace lvcalib
