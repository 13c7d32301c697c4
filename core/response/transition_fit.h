// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

namespace lvcalib {

/// A point of the transition.
struct TransitionPoint {
  double distance_m = 0.0;  ///< From the edge, outside positive.
  double intensity = 0.0;
};

/// I(d) = μ_in (1−λ) + μ_out λ with λ = ½[1 + erf((d−δ)/(√2 σ))] (LV-Calib, eq. 10), fitted, with
/// the standard deviation of every parameter.
struct TransitionFit {
  double mu_in = 0.0;
  double mu_out = 0.0;
  double delta_m = 0.0;
  double sigma_m = 0.0;
  double mu_in_sigma = 0.0;
  double mu_out_sigma = 0.0;
  double delta_sigma_m = 0.0;
  double sigma_sigma_m = 0.0;
  double noise = 0.0;  ///< Standard deviation of a sample on the plateaus.
  int samples = 0;     ///< That took part, outliers left out.
};

/// Robust fit (Tukey, scale from the data), with standard deviations that hold although samples in
/// the transition scatter more than those on the plateaus (sandwich covariance).
/// `sigma_start_m` is a first width. Nothing if the data do not show a transition: fewer than 20
/// points, all on one side, or no rise that stands clear of the noise.
std::optional<TransitionFit> fit_transition(std::span<const TransitionPoint> points,
                                            double sigma_start_m);

}  // namespace lvcalib
