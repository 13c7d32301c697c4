// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace lvcalib {

/// One covariate that a curve runs over: an interval, or labels.
struct CurveAxis {
  double low = 0.0;
  double high = 0.0;
  std::vector<double> labels;  ///< Sorted; not empty for categories.
  [[nodiscard]] bool categories() const { return !labels.empty(); }
};

/// Columns of a penalised spline (P-spline; Eilers and Marx 1996) of one covariate, or of a tensor
/// product of two. The second differences of the B-splines' coefficients are penalised; in the
/// penalty's eigenbasis this is an independent prior for each column, so that the columns are:
/// first those that the penalty leaves free (linear; for two covariates linear in each and their
/// product), then the penalised ones, scaled so that with weights of unit variance their sum has an
/// RMS of 1 over the interval. Constants are taken out (mean zero over the interval): pose, levels
/// or an effect of the catalogue hold them. Labels have a column each.
class CurveBasis {
 public:
  /// One axis or two; `splines` (4 or more) along each.
  CurveBasis(std::vector<CurveAxis> axes, int splines);

  [[nodiscard]] const std::vector<CurveAxis>& axes() const { return axes_; }
  [[nodiscard]] int columns() const { return free_ + static_cast<int>(penalised_.cols()); }
  /// How many of the first columns are not penalised.
  [[nodiscard]] int free_columns() const { return free_; }
  /// Values outside an interval count as its end; labels unknown to the axis give zeros.
  void evaluate(std::span<const double> at, std::span<double> columns) const;

 private:
  [[nodiscard]] Eigen::VectorXd splines_at(const CurveAxis& axis, double x) const;
  [[nodiscard]] Eigen::VectorXd raw(std::span<const double> at) const;
  void make_penalised();

  std::vector<CurveAxis> axes_;
  int splines_;
  int free_ = 0;
  Eigen::MatrixXd penalised_;  ///< Raw splines to penalised columns.
  Eigen::VectorXd mean_;       ///< Of all columns over the interval.
};

}  // namespace lvcalib
