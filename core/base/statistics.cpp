// SPDX-License-Identifier: BSD-3-Clause
#include "base/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>

namespace lvcalib {

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double position = std::clamp(q, 0.0, 1.0) * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(position);
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(low);
  std::nth_element(values.begin(), nth, values.end());
  const double at_low = *nth;
  const double fraction = position - static_cast<double>(low);
  if (fraction == 0.0) return at_low;
  const double at_high = *std::min_element(nth + 1, values.end());
  return at_low + fraction * (at_high - at_low);
}

double median(std::vector<double> values) {
  return quantile(std::move(values), 0.5);
}

double mad_sigma(std::vector<double> values) {
  const double centre = median(values);
  for (double& v : values) v = std::abs(v - centre);
  return 1.4826 * median(std::move(values));
}

BoxSummary box_summary(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  BoxSummary box;
  box.count = values.size();
  if (values.empty()) return box;
  std::sort(values.begin(), values.end());
  box.lower_quartile = quantile(values, 0.25);
  box.median = quantile(values, 0.5);
  box.upper_quartile = quantile(values, 0.75);
  const double reach = 1.5 * (box.upper_quartile - box.lower_quartile);
  // Whiskers end at values, and never inside the box.
  box.lower_whisker = box.lower_quartile;
  box.upper_whisker = box.upper_quartile;
  for (const double v : values) {
    if (v < box.lower_quartile - reach || v > box.upper_quartile + reach) {
      box.outliers.push_back(v);
    } else {
      box.lower_whisker = std::min(box.lower_whisker, v);
      box.upper_whisker = std::max(box.upper_whisker, v);
    }
  }
  return box;
}

double rms(std::span<const double> values) {
  if (values.empty()) return 0.0;
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double huber_weight(double residual, double threshold) {
  const double a = std::abs(residual);
  return a <= threshold ? 1.0 : threshold / a;
}

double tukey_weight(double residual, double threshold) {
  const double u = residual / threshold;
  if (std::abs(u) >= 1.0) return 0.0;
  const double k = 1.0 - u * u;
  return k * k;
}

namespace {

// Values of the normal distribution at steps, for Taylor's series in between.
class NormalTable {
 public:
  // Beyond it a tail of 10⁻⁹ is left, which nothing that is called often asks for.
  static constexpr double kEnd = 6.0;

  NormalTable() {
    for (int k = 0; k <= kSteps; ++k) {
      const double x = k * kStep - kEnd;
      nodes_[static_cast<std::size_t>(k)] = {0.5 * std::erfc(-x / std::numbers::sqrt2),
                                             normal_pdf(x)};
    }
  }

  // Derivatives of the density are Hermite's polynomials times it. What is left out, of the sixth
  // order, is below 2·10⁻¹³ and, relative to the tail, 10⁻⁹.
  [[nodiscard]] double cdf(double x) const {
    const auto k = static_cast<std::size_t>((x + kEnd) / kStep + 0.5);
    const double a = static_cast<double>(k) * kStep - kEnd;
    const double h = x - a;
    const double aa = a * a;
    const double series =
        1.0 -
        h / 2.0 *
            (a -
             h / 3.0 * (aa - 1.0 - h / 4.0 * (a * (aa - 3.0) - h / 5.0 * (aa * (aa - 6.0) + 3.0))));
    return nodes_[k].cdf + nodes_[k].pdf * h * series;
  }

 private:
  static constexpr double kStep = 1.0 / 32.0;
  static constexpr int kSteps = static_cast<int>(2.0 * kEnd / kStep);
  struct Node {
    double cdf, pdf;
  };
  std::array<Node, kSteps + 1> nodes_{};
};

// Without long double in between, which takes three times as long for two more digits. What is
// not defined is not a number.
namespace policies = boost::math::policies;
using Plain = policies::policy<policies::promote_double<false>,
                               policies::domain_error<policies::ignore_error>,
                               policies::overflow_error<policies::ignore_error>>;

}  // namespace

double normal_cdf(double x) {
  static const NormalTable table;
  if (std::abs(x) < NormalTable::kEnd) return table.cdf(x);
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

double normal_quantile(double p) {
  return -std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * p, Plain());
}

double normal_pdf(double x) {
  return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
}

double chi_square_gate(int degrees_of_freedom, double tail) {
  return 2.0 * boost::math::gamma_q_inv(0.5 * degrees_of_freedom, tail, Plain());
}

double f_gate(int degrees_of_freedom, double noise_freedom, double tail) {
  if (!(noise_freedom >= 1.0)) return std::numeric_limits<double>::infinity();
  const boost::math::fisher_f_distribution<double, Plain> f(degrees_of_freedom, noise_freedom);
  return degrees_of_freedom * boost::math::quantile(boost::math::complement(f, tail));
}

double f_tail(int degrees_of_freedom, double noise_freedom, double f) {
  const boost::math::fisher_f_distribution<double, Plain> distribution(degrees_of_freedom,
                                                                       noise_freedom);
  return boost::math::cdf(boost::math::complement(distribution, f));
}

double student_gate(double degrees_of_freedom, double tail) {
  const boost::math::students_t_distribution<double, Plain> t(degrees_of_freedom);
  return boost::math::quantile(boost::math::complement(t, tail));
}

double poisson_tail(double count, double mean) {
  return boost::math::gamma_p(count, mean, Plain());
}

}  // namespace lvcalib
