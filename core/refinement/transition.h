// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "refinement/board_refinement.h"
#include "refinement/transition_noise.h"

namespace lvcalib {

/// A sample about one node, unwrapped into angle and distance.
struct UnwrappedSample {
  double cos_psi = 1.0;
  double sin_psi = 0.0;
  double distance_m = 0.0;  ///< From the circle, outside positive.
  double level = 0.0;       ///< (I − inner)/(outer − inner): 0 black, 1 white.
  int bin = 0;
  double leverage = 0.0;  ///< Share of its noise that the fit it is measured from has taken.
};

/// The intensity transition across a circle's edge, common to all nodes of a scene:
/// level(d) = Φ(d/σ(ψ)) with σ² = eᵀ S e, e the outward direction, S the footprint's covariance;
/// and how the noise of a sample depends on its place in the transition.
class TransitionModel {
 public:
  explicit TransitionModel(double sigma_m);

  [[nodiscard]] double sigma_m(const UnwrappedSample& s) const;
  [[nodiscard]] const TransitionNoise& noise() const { return noise_; }
  /// Share of a sample's noise that a fit takes which knows its distance with that variance.
  [[nodiscard]] double leverage(const UnwrappedSample& s, double distance_variance_m2) const;
  /// Whether a level is none that a mixture of black and white could have given. Levels between
  /// the two are never strays: a beam that jitters jumps from one to the other.
  [[nodiscard]] bool is_stray(double level) const;
  [[nodiscard]] const Eigen::Matrix2d& footprint_m2() const { return footprint_; }
  /// Mean standard deviation over all directions.
  [[nodiscard]] double mean_sigma_m() const;

  /// Re-estimates footprint and noise from samples whose distances are measured from the fitted
  /// circles. Keeps the old footprint where the data cannot tell.
  void update(const std::vector<UnwrappedSample>& samples, double min_sigma_m, double max_sigma_m);

 private:
  void update_footprint(const std::vector<UnwrappedSample>& samples, double min_sigma_m,
                        double max_sigma_m);
  void update_noise(const std::vector<UnwrappedSample>& samples);

  Eigen::Matrix2d footprint_;
  TransitionNoise noise_;
};

/// Mid-level crossing of one bin's samples under the model. Sets midpoint, sigma, angle and state.
void solve_crossing(const std::vector<UnwrappedSample>& samples, const TransitionModel& model,
                    double window_in_m, double window_out_m, int min_samples, BinRecord& bin);

/// One step from an expected crossing, which is surer than the bin's own: what the samples say
/// about it is linear in their noise then, and so is the standard deviation right. Sets midpoint,
/// sigma and angle.
void step_crossing(const std::vector<UnwrappedSample>& samples, const TransitionModel& model,
                   double expected_m, BinRecord& bin);

/// The ring in which a bin's midpoint is looked for, and where in it the plateaus begin.
struct MidpointWindow {
  double inside_m = 0.0;
  double outside_m = 0.0;
  double clear_inside_m = 0.0;   ///< Samples farther in are black.
  double clear_outside_m = 0.0;  ///< Samples farther out are white.
};

/// Mid-level crossing of one bin as the paper has it: the two levels are medians of the bin's own
/// samples, the profile is that of medians of distance and level in ten slots, and the crossing
/// nearest to the circle is interpolated linearly. Sets midpoint and state, and as sigma
/// 1/√(contrast · samples): weights alone, in no unit.
void interpolate_midpoint(const std::vector<UnwrappedSample>& samples, const MidpointWindow& window,
                          int min_samples, double min_contrast, BinRecord& bin);

}  // namespace lvcalib
