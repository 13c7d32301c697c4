// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lvcalib {

/// The normal distribution lies below so many standard deviations with probability 0.95.
inline constexpr double kUpper95 = 1.645;

/// Quantile q in [0, 1] by linear interpolation between order statistics. NaN for no values.
/// Takes its argument by value, since it is reordered.
double quantile(std::vector<double> values, double q);

/// Median; NaN for no values.
double median(std::vector<double> values);

/// 1.4826 · median |x − median(x)|: the standard deviation of Gaussian data, robust to 50 %
/// outliers. NaN for no values.
double mad_sigma(std::vector<double> values);

/// What a box plot shows (Tukey 1977): quartiles, whiskers to the last values within 1.5
/// interquartile ranges of the box, and the values beyond.
struct BoxSummary {
  double lower_whisker = 0.0;
  double lower_quartile = 0.0;
  double median = 0.0;
  double upper_quartile = 0.0;
  double upper_whisker = 0.0;
  std::vector<double> outliers;  ///< Sorted.
  std::size_t count = 0;         ///< 0: nothing to draw, all else 0. NaN are left out.
};
BoxSummary box_summary(std::vector<double> values);

/// Root mean square; 0 for no values.
double rms(std::span<const double> values);

/// Weight ρ'(r)/r of Huber's loss for a residual in units of its standard deviation.
double huber_weight(double residual, double threshold = 1.345);

/// Weight of Tukey's biweight loss; zero beyond the threshold.
double tukey_weight(double residual, double threshold = 4.685);

/// Standard normal cumulative distribution function.
double normal_cdf(double x);

/// Its inverse, to 10⁻¹⁵ relative to 1 + |x|, for 0 < p < 1.
double normal_quantile(double p);

/// Standard normal density.
double normal_pdf(double x);

/// Upper quantile of the χ² distribution, for gates: P(χ² > result) = tail. Not a number without a
/// degree of freedom.
double chi_square_gate(int degrees_of_freedom, double tail);

/// The same for squares whose unit, a variance, is itself an estimate from `noise_freedom`
/// residuals: degrees_of_freedom times the upper quantile of the F distribution. Infinite where no
/// residual tells the noise.
double f_gate(int degrees_of_freedom, double noise_freedom, double tail);

/// P(F > f) for the F distribution of a mean of squares of so many degrees of freedom over one of
/// `noise_freedom`.
double f_tail(int degrees_of_freedom, double noise_freedom, double f);

/// Upper quantile of Student's t distribution: P(t > result) = tail.
double student_gate(double degrees_of_freedom, double tail);

/// P(X ≥ count) of a Poisson variable with this mean; count > 0 need not be whole.
double poisson_tail(double count, double mean);

}  // namespace lvcalib
