// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace lvcalib {

/// Running sums of pairs (x, y), for Pearson's correlation and the regression of y on x. Meant for
/// values about one (print, intensities): sums of squares, not of deviations from a mean.
struct PairedMoments {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;

  void add(double x_value, double y_value) {
    n += 1.0;
    x += x_value;
    y += y_value;
    xx += x_value * x_value;
    yy += y_value * y_value;
    xy += x_value * y_value;
  }
  /// Sums of squared deviations from the means, and of their products.
  [[nodiscard]] double x_squares() const { return xx - x * x / n; }
  [[nodiscard]] double y_squares() const { return yy - y * y / n; }
  [[nodiscard]] double products() const { return xy - x * y / n; }
  /// Zero where one of the two does not vary.
  [[nodiscard]] double correlation() const {
    const double vx = x_squares();
    const double vy = y_squares();
    return vx > 0.0 && vy > 0.0 ? products() / std::sqrt(vx * vy) : 0.0;
  }
  /// Of y by x; zero where x does not vary.
  [[nodiscard]] double slope() const {
    const double vx = x_squares();
    return vx > 0.0 ? products() / vx : 0.0;
  }
};

}  // namespace lvcalib
