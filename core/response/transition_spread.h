// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>
#include <vector>

namespace lvcalib {

/// Intensities well on either side of an edge.
struct PlateauLevels {
  double in = 0.0, out = 0.0;
  double noise_in = 0.0, noise_out = 0.0;  ///< Robust standard deviations.
  /// Whether an intensity is none that a mixture of the two could have given.
  [[nodiscard]] bool is_stray(double intensity) const;
  [[nodiscard]] bool stand_clear() const;
};

/// Levels of samples (z = distance/σ, intensity) beyond |z| = 2 (or the outer two fifths where the
/// samples do not reach so far), as medians. Nothing with fewer than ten on either side.
std::optional<PlateauLevels> plateau_levels(const std::vector<std::pair<double, double>>& samples);

/// How samples scatter about the mean level λ(z): the plateaus' noise, and the share c of
/// contrast²·λ(1−λ) that beams jumping between the levels add: 1 for a thin beam that jitters,
/// near 0 for a wide one that does not. One number for the whole transition, since measuring every
/// place by itself would give weight to where rare jumps happen to be missing.
class TransitionSpread {
 public:
  void clear();
  void add(double lambda, double residual, const PlateauLevels& levels);
  /// Ends a round of add().
  void finish();
  [[nodiscard]] double variance(double lambda, const PlateauLevels& levels) const;

 private:
  double excess_ = 0.0;
  double mixing_ = 0.0;
  double share_ = 0.1;
};

}  // namespace lvcalib
