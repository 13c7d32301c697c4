// SPDX-License-Identifier: BSD-3-Clause
#include "response/angular_width.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "base/statistics.h"
#include "response/transition_spread.h"

namespace lvcalib {
namespace {

constexpr std::size_t kFewestForWidth = 40;

using Unknowns = Eigen::Matrix<double, 6, 1>;  // A_pp, A_py, A_yy, δ, μ_in, μ_out
using Normal = Eigen::Matrix<double, 6, 6>;

Eigen::Vector3d quadratic_terms(const BoundarySample& s) {
  const Eigen::Vector2d b = s.across_m.cast<double>();
  return {b.x() * b.x(), 2.0 * b.x() * b.y(), b.y() * b.y()};
}

class WidthFit {
 public:
  explicit WidthFit(const std::vector<const BoundarySample*>& samples) : samples_(samples) {}

  std::optional<AngularWidth> run() {
    if (samples_.size() < kFewestForWidth || !start()) return std::nullopt;
    constexpr int kIterations = 30;
    constexpr int kSpreadRounds = 8;
    constexpr int kFewestRounds = 4;
    constexpr double kSettled = 1e-3;  // Far below what the samples can tell.
    double change = 1.0;
    for (int i = 0; i < kIterations && (i < kFewestRounds || change > kSettled); ++i) {
      if (i < kSpreadRounds) pass(true);
      pass(false);
      const Unknowns step = normal_.ldlt().solve(rhs_);
      if (!step.allFinite()) return std::nullopt;
      change = take(step);
    }
    pass(false);
    return finish();
  }

 private:
  // First ellipse: round, as wide as the samples say.
  bool start() {
    std::vector<double> width;
    std::vector<std::pair<double, double>> z;
    for (const BoundarySample* s : samples_) {
      const double w = static_cast<double>(s->width_m);
      width.push_back(w / static_cast<double>(s->across_m.norm()));
      z.emplace_back(static_cast<double>(s->distance_m) / w, static_cast<double>(s->intensity));
    }
    const auto levels = plateau_levels(z);
    if (!levels || !levels->stand_clear()) return false;
    levels_ = *levels;
    const double round = std::pow(median(std::move(width)), 2);
    x_ << round, 0.0, round, 0.0, levels_.in, levels_.out;
    return true;
  }

  // One pass over the samples: measures the spread, or builds the normal equations.
  void pass(bool spread) {
    if (spread) spread_.clear();
    normal_.setZero();
    scatter_.setZero();
    rhs_.setZero();
    const double contrast = x_(5) - x_(4);
    for (const BoundarySample* s : samples_) {
      const auto intensity = static_cast<double>(s->intensity);
      if (levels_.is_stray(intensity)) continue;
      const Eigen::Vector3d q = quadratic_terms(*s);
      const double variance = std::max(1e-12, q.dot(x_.head<3>()));
      const double sigma = std::sqrt(variance);
      const double z = (static_cast<double>(s->distance_m) - x_(3)) / sigma;
      const double lambda = normal_cdf(z);
      const double r = intensity - (x_(4) + contrast * lambda);
      if (spread) {
        spread_.add(lambda, r, levels_);
        continue;
      }
      const double slope = contrast * normal_pdf(z);
      Unknowns j;
      j << -slope * z / (2.0 * variance) * q, -slope / sigma, 1.0 - lambda, lambda;
      const double weight = 1.0 / spread_.variance(lambda, levels_);
      normal_ += weight * j * j.transpose();
      scatter_ += weight * weight * r * r * j * j.transpose();
      rhs_ += weight * r * j;
    }
    if (spread) spread_.finish();
  }

  // Takes the step, keeping the ellipse positive and its growth within a factor of two.
  double take(const Unknowns& step) {
    const Unknowns old = x_;
    x_ += step;
    Eigen::Matrix2d a;
    a << x_(0), x_(1), x_(1), x_(2);
    const double trace = old(0) + old(2);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(a);
    const Eigen::Vector2d bounded = axes.eigenvalues().cwiseMax(0.01 * trace).cwiseMin(2.0 * trace);
    a = axes.eigenvectors() * bounded.asDiagonal() * axes.eigenvectors().transpose();
    x_.head<3>() << a(0, 0), a(0, 1), a(1, 1);
    return (x_.head<3>() - old.head<3>()).norm() / trace;
  }

  std::optional<AngularWidth> finish() const {
    const Normal inverse = normal_.ldlt().solve(Normal::Identity());
    const Normal covariance = inverse * scatter_ * inverse;
    const double trace = x_(0) + x_(2);
    const double variance = covariance(0, 0) + 2.0 * covariance(0, 2) + covariance(2, 2);
    if (!x_.allFinite() || !(trace > 0.0) || !(variance >= 0.0)) return std::nullopt;
    AngularWidth out;
    out.covariance_rad2 << x_(0), x_(1), x_(1), x_(2);
    out.delta_m = x_(3);
    out.relative_sigma = 0.5 * std::sqrt(variance) / trace;
    return out;
  }

  const std::vector<const BoundarySample*>& samples_;
  PlateauLevels levels_;
  TransitionSpread spread_;
  Unknowns x_ = Unknowns::Zero();
  Normal normal_ = Normal::Zero();
  Normal scatter_ = Normal::Zero();
  Unknowns rhs_ = Unknowns::Zero();
};

}  // namespace

std::optional<AngularWidth> fit_angular_width(const std::vector<const BoundarySample*>& samples) {
  return WidthFit(samples).run();
}

}  // namespace lvcalib
