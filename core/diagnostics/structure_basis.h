// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The shapes that the search for structure fits to residuals.

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "diagnostics/covariates.h"

namespace lvcalib {

/// Values that are not zero in a row, with their columns.
struct BasisRow {
  std::array<int, 16> column{};
  std::array<double, 16> value{};
  int count = 0;
  int run = 1;  ///< So many at a time, 1 or kSplineRun, stand in columns beside each other.
};
constexpr int kSplineRun = 4;  ///< Cubic splines that are not zero anywhere.

/// Cubic B-splines over quantiles of the covariate; categories have one column each.
class Basis {
 public:
  Basis(const Covariate& covariate, int splines)
      : categories_(covariate.categories), intervals_(splines - 3) {
    if (categories_) {
      for (const float label : covariate.values) {
        const auto at = std::lower_bound(knots_.begin(), knots_.end(), label);
        if (at == knots_.end() || *at != label) knots_.insert(at, label);
      }
      return;
    }
    // Shares of some thousands of rows are those of all to a hundredth.
    constexpr std::size_t kEnough = 5000;
    const std::size_t stride = std::max<std::size_t>(1, covariate.values.size() / kEnough);
    std::vector<float> sorted;
    for (std::size_t k = 0; k < covariate.values.size(); k += stride)
      sorted.push_back(covariate.values[k]);
    std::sort(sorted.begin(), sorted.end());
    // Equal shares of rows between knots keep every spline supported.
    for (int k = 0; k <= intervals_; ++k) {
      const auto at = static_cast<std::size_t>(static_cast<double>(k) / intervals_ *
                                               static_cast<double>(sorted.size() - 1));
      knots_.push_back(sorted[at]);
    }
    for (std::size_t k = 0; k + 1 < knots_.size(); ++k) {
      const double width = static_cast<double>(knots_[k + 1]) - knots_[k];
      per_width_.push_back(width > 0.0 ? 1.0 / width : 0.0);
    }
  }

  [[nodiscard]] int size() const {
    return categories_ ? static_cast<int>(knots_.size()) : intervals_ + 3;
  }

  // Called for every row of every shape; what it writes is read at once.
  [[gnu::always_inline]] void evaluate(float x, BasisRow& out) const {
    if (categories_) {
      out.count = out.run = 1;
      out.value[0] = 1.0;
      out.column[0] =
          static_cast<int>(std::lower_bound(knots_.begin(), knots_.end(), x) - knots_.begin());
      return;
    }
    // Knots are few: counting those passed is faster than a search whose branches nobody foresees.
    int interval = 0;
    for (std::size_t k = 1; k + 1 < knots_.size(); ++k) interval += x < knots_[k] ? 0 : 1;
    const auto at = static_cast<std::size_t>(interval);
    const double t = std::clamp((static_cast<double>(x) - knots_[at]) * per_width_[at], 0.0, 1.0);
    const double u = 1.0 - t;
    out.count = out.run = kSplineRun;
    for (int k = 0; k < kSplineRun; ++k) out.column[static_cast<std::size_t>(k)] = interval + k;
    constexpr double kSixth = 1.0 / 6.0;
    out.value[0] = kSixth * u * u * u;
    out.value[1] = kSixth * (3 * t * t * t - 6 * t * t + 4);
    out.value[2] = kSixth * (3 * u * u * u - 6 * u * u + 4);
    out.value[3] = kSixth * t * t * t;
  }

 private:
  bool categories_;
  int intervals_;
  std::vector<float> knots_;       // or labels
  std::vector<double> per_width_;  // 1 / width of each interval between knots; 0 if it has none
};

/// A curve over one covariate, evaluated at row k.
class Curve {
 public:
  static constexpr bool kLocal = false;
  static constexpr std::array kPriorRows{1.0};
  Curve(const Covariate& covariate, int splines) : of_(covariate), basis_(covariate, splines) {}
  [[nodiscard]] int size() const { return basis_.size(); }
  void evaluate(std::size_t k, BasisRow& out) const { basis_.evaluate(of_.values[k], out); }

 private:
  const Covariate& of_;
  Basis basis_;
};

/// One number for all rows.
class Constant {
 public:
  static constexpr bool kLocal = false;
  static constexpr std::array kPriorRows{1.0};
  [[nodiscard]] static int size() { return 1; }
  static void evaluate(std::size_t, BasisRow& out) {
    out.count = out.run = 1;
    out.value[0] = 1.0;
    out.column[0] = 0;
  }
};

/// Products of splines over two covariates.
class Surface {
 public:
  static constexpr bool kLocal = true;
  static constexpr std::array kPriorRows{1.0, 10.0, 100.0, 1000.0};
  Surface(const Covariate& x, const Covariate& y, int splines = 8)
      : x_(x), y_(y), basis_x_(x, splines), basis_y_(y, splines) {}
  [[nodiscard]] int size() const { return basis_x_.size() * basis_y_.size(); }
  void evaluate(std::size_t k, BasisRow& out) const {
    BasisRow bx;
    BasisRow by;
    basis_x_.evaluate(x_.values[k], bx);
    basis_y_.evaluate(y_.values[k], by);
    std::size_t n = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(bx.count); ++i) {
      for (std::size_t j = 0; j < static_cast<std::size_t>(by.count); ++j, ++n) {
        out.column[n] = bx.column[i] * basis_y_.size() + by.column[j];
        out.value[n] = bx.value[i] * by.value[j];
      }
    }
    out.count = static_cast<int>(n);
    out.run = by.run;
  }

 private:
  const Covariate& x_;
  const Covariate& y_;
  Basis basis_x_;
  Basis basis_y_;
};

/// A displacement over the image: a surface for u and one for v.
class ImageSurface {
 public:
  static constexpr bool kLocal = true;
  static constexpr std::array kPriorRows = Surface::kPriorRows;
  static constexpr int kSplines = 10;  ///< In either direction: corners are few and precise.
  ImageSurface(const Covariate& x, const Covariate& y, const std::vector<std::size_t>& rows)
      : surface_(x, y, kSplines), rows_(rows) {}
  [[nodiscard]] int size() const { return 2 * surface_.size(); }
  void evaluate(std::size_t k, BasisRow& out) const {
    surface_.evaluate(k, out);
    const bool is_v = k > 0 && rows_[k] == rows_[k - 1];
    if (!is_v) return;
    for (int i = 0; i < out.count; ++i) out.column[static_cast<std::size_t>(i)] += surface_.size();
  }

 private:
  Surface surface_;
  const std::vector<std::size_t>& rows_;  // of the table, by residual
};

}  // namespace lvcalib
