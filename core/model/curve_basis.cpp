// SPDX-License-Identifier: BSD-3-Clause
#include "model/curve_basis.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/symmetric.h"

namespace lvcalib {
namespace {

constexpr int kDegree = 3;
// Places along an axis, or along each of two, for means and scales.
constexpr int kAlong = 401;
constexpr int kAlongEach = 41;

// −1 … 1 along an interval.
double unit_of_interval(const CurveAxis& axis, double x) {
  const double middle = 0.5 * (axis.low + axis.high);
  const double half = 0.5 * (axis.high - axis.low);
  return half > 0.0 ? std::clamp((x - middle) / half, -1.0, 1.0) : 0.0;
}

Eigen::MatrixXd second_difference_penalty(int n) {
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(n - 2, n);
  for (int k = 0; k + 2 < n; ++k) d.block<1, 3>(k, k) << 1.0, -2.0, 1.0;
  return d.transpose() * d;
}

Eigen::MatrixXd kronecker(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd out(a.rows() * b.rows(), a.cols() * b.cols());
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index j = 0; j < a.cols(); ++j)
      out.block(i * b.rows(), j * b.cols(), b.rows(), b.cols()) = a(i, j) * b;
  }
  return out;
}

// Points spread evenly over the axes.
std::vector<std::array<double, 2>> samples_of(const std::vector<CurveAxis>& axes) {
  std::vector<std::array<double, 2>> out;
  const int count = axes.size() == 1 ? kAlong : kAlongEach;
  const auto at = [count](const CurveAxis& axis, int k) {
    return axis.low + (axis.high - axis.low) * k / (count - 1.0);
  };
  for (int i = 0; i < count; ++i) {
    if (axes.size() == 1) {
      out.push_back({at(axes[0], i), 0.0});
      continue;
    }
    for (int j = 0; j < count; ++j) out.push_back({at(axes[0], i), at(axes[1], j)});
  }
  return out;
}

}  // namespace

CurveBasis::CurveBasis(std::vector<CurveAxis> axes, int splines)
    : axes_(std::move(axes)), splines_(std::max(splines, kDegree + 1)) {
  if (axes_[0].categories()) {
    const auto n = static_cast<Eigen::Index>(axes_[0].labels.size());
    penalised_ = Eigen::MatrixXd::Identity(n, n);
    mean_ = Eigen::VectorXd::Constant(n, 1.0 / static_cast<double>(n));
    return;
  }
  free_ = axes_.size() == 1 ? 1 : 3;
  make_penalised();
  // evaluate() subtracts the mean once there is one.
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(columns());
  Eigen::VectorXd all(columns());
  const auto samples = samples_of(axes_);
  for (const auto& at : samples) {
    evaluate(std::span(at).first(axes_.size()), {all.data(), static_cast<std::size_t>(all.size())});
    mean += all / static_cast<double>(samples.size());
  }
  mean_ = std::move(mean);
}

// Eigenvectors of the penalty, each divided by the root of its eigenvalue.
void CurveBasis::make_penalised() {
  const Eigen::MatrixXd along = second_difference_penalty(splines_);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(splines_, splines_);
  const Eigen::MatrixXd penalty =
      axes_.size() == 1 ? along : Eigen::MatrixXd(kronecker(along, one) + kronecker(one, along));
  const auto axes = axes_of(penalty);
  const Eigen::Index null = axes_.size() == 1 ? 2 : 4;  // constant and linear parts
  const Eigen::Index count = penalty.rows() - null;
  penalised_ = axes.vectors.rightCols(count) *
               axes.values.tail(count).cwiseSqrt().cwiseInverse().asDiagonal();
  const auto samples = samples_of(axes_);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(count);
  double squares = 0.0;
  for (const auto& at : samples) {
    const Eigen::VectorXd columns = penalised_.transpose() * raw(std::span(at).first(axes_.size()));
    sum += columns;
    squares += columns.squaredNorm();
  }
  const auto n = static_cast<double>(samples.size());
  penalised_ /= std::sqrt(squares / n - (sum / n).squaredNorm());
}

Eigen::VectorXd CurveBasis::splines_at(const CurveAxis& axis, double x) const {
  const int intervals = splines_ - kDegree;
  const double place = 0.5 * (unit_of_interval(axis, x) + 1.0) * intervals;
  const int first = std::min(static_cast<int>(place), intervals - 1);
  const double t = place - first;
  const double u = 1.0 - t;
  Eigen::VectorXd out = Eigen::VectorXd::Zero(splines_);
  out.segment<4>(first) << u * u * u / 6.0, (3 * t * t * t - 6 * t * t + 4) / 6.0,
      (3 * u * u * u - 6 * u * u + 4) / 6.0, t * t * t / 6.0;
  return out;
}

Eigen::VectorXd CurveBasis::raw(std::span<const double> at) const {
  if (axes_[0].categories()) {
    const auto& labels = axes_[0].labels;
    Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(labels.size()));
    const auto found = std::lower_bound(labels.begin(), labels.end(), at[0]);
    if (found != labels.end() && *found == at[0]) out(found - labels.begin()) = 1.0;
    return out;
  }
  const Eigen::VectorXd a = splines_at(axes_[0], at[0]);
  if (axes_.size() == 1) return a;
  return kronecker(a, splines_at(axes_[1], at[1]));
}

void CurveBasis::evaluate(std::span<const double> at, std::span<double> columns) const {
  Eigen::Map<Eigen::VectorXd> out(columns.data(), static_cast<Eigen::Index>(columns.size()));
  const Eigen::VectorXd splines = raw(at);
  if (axes_[0].categories() && splines.sum() == 0.0) {
    out.setZero();
    return;
  }
  if (free_ > 0) out(0) = unit_of_interval(axes_[0], at[0]);
  if (free_ > 1) {
    out(1) = unit_of_interval(axes_[1], at[1]);
    out(2) = out(0) * out(1);
  }
  out.tail(penalised_.cols()).noalias() = penalised_.transpose() * splines;
  if (mean_.size() == out.size()) out -= mean_;
}

}  // namespace lvcalib
