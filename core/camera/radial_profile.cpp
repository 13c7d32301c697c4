// SPDX-License-Identifier: BSD-3-Clause
#include "camera/radial_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lvcalib {
namespace {

constexpr int kMaxDegree = 8;
// Halvings after which a polynomial that is neither clearly positive nor clearly negative is taken
// as touching zero: the cell is then far below the spacing of double-precision radii that matter.
constexpr int kMaxHalvings = 40;
constexpr int kMaxDoublings = 200;

using Bernstein = std::array<double, kMaxDegree + 1>;

bool bernstein_positive(const Bernstein& b, int degree, int halvings) {
  if (!(b[0] > 0.0) || !(b[static_cast<std::size_t>(degree)] > 0.0)) return false;
  const auto end = b.begin() + degree + 1;
  if (std::all_of(b.begin(), end, [](double v) { return v > 0.0; })) return true;
  if (halvings == 0) return false;
  // De Casteljau: both halves' coefficients from the triangle of averages.
  Bernstein left{};
  Bernstein right = b;
  for (int level = 0; level <= degree; ++level) {
    left[static_cast<std::size_t>(level)] = right[0];
    for (int i = 0; i + level < degree; ++i) {
      const auto k = static_cast<std::size_t>(i);
      right[k] = 0.5 * (right[k] + right[k + 1]);
    }
  }
  return bernstein_positive(left, degree, halvings - 1) &&
         bernstein_positive(right, degree, halvings - 1);
}

double evaluate(const double* c, int degree, double s) {
  double sum = c[degree];
  for (int i = degree - 1; i >= 0; --i) sum = sum * s + c[i];
  return sum;
}

double evaluate_derivative(const double* c, int degree, double s) {
  double sum = 0.0;
  for (int i = degree; i >= 1; --i) sum = sum * s + i * c[i];
  return sum;
}

}  // namespace

bool positive_on(const double* coefficients, int degree, double end) {
  // The sum of the falling terms bounds the polynomial from below; enough for most points.
  double bound = coefficients[0];
  double magnitude = std::abs(coefficients[0]);
  double power = 1.0;
  Bernstein scaled{coefficients[0]};
  for (int i = 1; i <= degree; ++i) {
    power *= end;
    scaled[static_cast<std::size_t>(i)] = coefficients[i] * power;
    magnitude += std::abs(coefficients[i] * power);
    bound += std::min(coefficients[i] * power, 0.0);
  }
  if (!std::isfinite(power) || !std::isfinite(magnitude)) return false;
  if (bound > 0.0) return true;
  // Power basis on [0, end] to Bernstein basis: b_j = Σ_i C(j,i)/C(degree,i)·a_i.
  Bernstein b{};
  for (int j = 0; j <= degree; ++j) {
    double weight = 1.0;
    for (int i = 0; i <= j; ++i) {
      b[static_cast<std::size_t>(j)] += weight * scaled[static_cast<std::size_t>(i)];
      weight *= static_cast<double>(j - i) / static_cast<double>(std::max(1, degree - i));
    }
  }
  return bernstein_positive(b, degree, kMaxHalvings);
}

RadialProfile::RadialProfile(const Camera& camera) {
  const auto& k = camera.distortion;
  largest_u_ = std::numeric_limits<double>::max();
  switch (camera.model) {
    case DistortionModel::kEquidistant:
      numerator_ = {1.0, k[0], k[1], k[2], k[3]};
      largest_u_ = std::numbers::pi;
      break;
    case DistortionModel::kRationalPolynomial:
      denominator_ = {1.0, k[5], k[6], k[7], 0.0};
      rational_ = k[5] != 0.0 || k[6] != 0.0 || k[7] != 0.0;
      [[fallthrough]];
    case DistortionModel::kPlumbBob:
      numerator_ = {1.0, k[0], k[1], k[4], 0.0};
      break;
  }
  if (!rational_) {
    slope_degree_ = kDegree;
    for (std::size_t i = 0; i <= kDegree; ++i) {
      slope_[i] = (2.0 * static_cast<double>(i) + 1.0) * numerator_[i];
    }
    return;
  }
  slope_degree_ = 2 * kDegree;
  slope_.fill(0.0);
  for (std::size_t i = 0; i <= kDegree; ++i) {
    for (std::size_t j = 0; j <= kDegree; ++j) {
      const double turn = 1.0 + 2.0 * (static_cast<double>(i) - static_cast<double>(j));
      slope_[i + j] += turn * numerator_[i] * denominator_[j];
    }
  }
}

RadialProfile::Ratio RadialProfile::ratio(double s) const {
  Ratio out;
  out.numerator = evaluate(numerator_.data(), kDegree, s);
  const double n_slope = evaluate_derivative(numerator_.data(), kDegree, s);
  if (!rational_) {
    out.value = out.numerator;
    out.derivative = n_slope;
    return out;
  }
  out.denominator = evaluate(denominator_.data(), kDegree, s);
  const double d_slope = evaluate_derivative(denominator_.data(), kDegree, s);
  out.value = out.numerator / out.denominator;
  out.derivative = (n_slope - out.value * d_slope) / out.denominator;
  return out;
}

bool RadialProfile::images(double u) const {
  if (!(u <= largest_u_)) return false;
  const double s = u * u;
  return positive_on(slope_.data(), slope_degree_, s) &&
         (!rational_ || positive_on(denominator_.data(), kDegree, s));
}

double RadialProfile::bracket(double distorted_u, double& low) const {
  low = 0.0;
  double high = std::min(distorted_u, largest_u_);
  for (int i = 0; i < kMaxDoublings && images(high) && distorted(high) < distorted_u; ++i) {
    low = high;
    if (high >= largest_u_) break;
    high = std::min(2.0 * high, largest_u_);
  }
  return high;
}

double RadialProfile::undistorted(double distorted_u) const {
  if (!(distorted_u > 0.0)) return 0.0;
  double low = 0.0;
  double high = bracket(distorted_u, low);
  // Newton inside the bracket, bisection where Newton would leave it. Each round shrinks the
  // bracket from one side at least; 200 rounds exhaust a double even by bisection alone.
  double u = 0.5 * (low + high);
  for (int i = 0; i < 200 && low < high; ++i) {
    const bool valid = images(u);
    const Ratio r = ratio(u * u);
    const double excess = u * r.value - distorted_u;
    (valid && excess <= 0.0 ? low : high) = u;
    const double slope = r.value + 2.0 * u * u * r.derivative;
    double next = u - excess / slope;
    if (!valid || !(next > low && next < high)) next = 0.5 * (low + high);
    if (next == u || (valid && std::abs(excess) <= 1e-15 * distorted_u)) break;
    u = next;
  }
  return images(u) ? u : low;
}

}  // namespace lvcalib
