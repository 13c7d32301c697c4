// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "camera/camera.h"

namespace lvcalib {

/// How a camera model stretches the distance from the optical axis: distorted radius g(u) of an
/// undistorted one, u = tan θ for plumb_bob and rational_polynomial, u = θ for equidistant.
/// With s = u²: g(u) = u·N(s)/D(s), N and D polynomials with N(0) = D(0) = 1.
/// The model images points only up to its first fold, the smallest u with g'(u) = 0: beyond it
/// two points share a pixel, even where g grows again.
class RadialProfile {
 public:
  explicit RadialProfile(const Camera& camera);

  struct Ratio {
    double value = 1.0;        ///< N/D
    double derivative = 0.0;   ///< d(N/D)/ds
    double numerator = 1.0;    ///< N
    double denominator = 1.0;  ///< D
  };
  [[nodiscard]] Ratio ratio(double s) const;
  [[nodiscard]] double distorted(double u) const { return u * ratio(u * u).value; }

  /// True if u lies before the first fold (and before the first pole of N/D).
  [[nodiscard]] bool images(double u) const;

  /// The largest u before the fold with g(u) ≤ distorted. Equal to g⁻¹(distorted) wherever that
  /// exists; the edge of the field otherwise.
  [[nodiscard]] double undistorted(double distorted) const;

 private:
  [[nodiscard]] double bracket(double distorted, double& low) const;

  static constexpr int kDegree = 4;  ///< Of N and D in s.
  std::array<double, kDegree + 1> numerator_{1.0};
  std::array<double, kDegree + 1> denominator_{1.0};
  bool rational_ = false;
  /// Numerator of g'(u) as a polynomial in s: N·D + 2s(N'·D − N·D').
  std::array<double, 2 * kDegree + 1> slope_{1.0};
  int slope_degree_ = 0;
  double largest_u_ = 0.0;
};

/// True if c[0] + c[1]·s + … + c[degree]·s^degree > 0 everywhere on [0, end]; decided exactly (up
/// to rounding) by bisection in the Bernstein basis, whose coefficients bound the polynomial.
/// `degree` is at most 8. False for coefficients that are not finite.
bool positive_on(const double* coefficients, int degree, double end);

}  // namespace lvcalib
