// SPDX-License-Identifier: BSD-3-Clause
#include "solve/bundle_adjustment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>

#include "base/statistics.h"

namespace lvcalib {
namespace {

using Matrix12 = Eigen::Matrix<double, kIntrinsics, kIntrinsics>;

// Huber's, in σ, as the joint solve has it for corners.
constexpr double kRobust = 4.0;
constexpr std::size_t kFewestPoints = 8;
constexpr int kMaxIterations = 60;
// Corners are never known better than this: a hundredth of a pixel is what the best of detectors
// reach on simulated images, a fifth of it what averaging could still give.
constexpr double kFloor_px = 0.002;

struct View {
  Matrix6d own = Matrix6d::Zero();
  Vector6d own_gradient = Vector6d::Zero();
  Eigen::Matrix<double, 6, kIntrinsics> coupling = Eigen::Matrix<double, 6, kIntrinsics>::Zero();
};

struct BundleState {
  Camera camera;
  std::vector<Rigid3> poses;
};

// Robust cost (½Σρ + prior) of a state; infinite if a point has no image.
struct BundleEquations {
  double cost = 0.0;
  double squares = 0.0;  // Σ w |e|²
  std::size_t rows = 0;
  Matrix12 intrinsics = Matrix12::Zero();
  IntrinsicsVector gradient = IntrinsicsVector::Zero();
  std::vector<View> views;
};

double huber_cost(double size) {
  return size <= kRobust ? 0.5 * size * size : kRobust * (size - 0.5 * kRobust);
}

BundleEquations linearize_bundle(const std::vector<SeenPoints>& views, const BundleState& state,
                                 double sigma_px, bool jacobians) {
  BundleEquations out;
  out.views.resize(views.size());
  for (std::size_t v = 0; v < views.size(); ++v) {
    View& view = out.views[v];
    for (std::size_t k = 0; k < views[v].point_m.size(); ++k) {
      const Eigen::Vector3d p = state.poses[v] * views[v].point_m[k];
      Eigen::Matrix<double, 2, 3> by_point;
      Eigen::Matrix<double, 2, kIntrinsics> a;
      const auto pixel =
          jacobians ? state.camera.project(p, &by_point, &a) : state.camera.project(p);
      if (!pixel) {
        out.cost = std::numeric_limits<double>::infinity();
        return out;
      }
      const Eigen::Vector2d e = views[v].pixel[k] - *pixel;
      const double size = e.norm() / sigma_px;
      const double w = huber_weight(size, kRobust) / (sigma_px * sigma_px);
      out.cost += huber_cost(size);
      out.squares += w * sigma_px * sigma_px * e.squaredNorm();
      out.rows += 2;
      if (!jacobians) continue;
      Eigen::Matrix<double, 3, 6> moved;
      moved << Eigen::Matrix3d::Identity(), -skew(p);
      const Eigen::Matrix<double, 2, 6> j = by_point * moved;
      view.own += w * j.transpose() * j;
      view.own_gradient += w * j.transpose() * e;
      view.coupling += w * j.transpose() * a;
      out.intrinsics += w * a.transpose() * a;
      out.gradient += w * a.transpose() * e;
    }
  }
  return out;
}

// Reduced normal equations of the intrinsics, in units of the prior; held entries are unit rows.
struct Reduced {
  Matrix12 information = Matrix12::Identity();
  IntrinsicsVector gradient = IntrinsicsVector::Zero();
};

Reduced reduce(const BundleEquations& at, const IntrinsicsVector& offset,
               const IntrinsicsVector& prior, double damping) {
  Matrix12 information = at.intrinsics;
  IntrinsicsVector gradient = at.gradient;
  for (const View& view : at.views) {
    Matrix6d own = view.own;
    own.diagonal() *= 1.0 + damping;
    const Eigen::LDLT<Matrix6d> factor(own);
    information -= view.coupling.transpose() * factor.solve(view.coupling);
    gradient -= view.coupling.transpose() * factor.solve(view.own_gradient);
  }
  Reduced out;
  for (Eigen::Index i = 0; i < kIntrinsics; ++i) {
    if (!(prior(i) > 0.0)) continue;
    for (Eigen::Index j = 0; j < kIntrinsics; ++j) {
      if (prior(j) > 0.0) out.information(i, j) = information(i, j) * prior(i) * prior(j);
    }
    out.information(i, i) = information(i, i) * prior(i) * prior(i) * (1.0 + damping) + 1.0;
    out.gradient(i) = gradient(i) * prior(i) - offset(i) / prior(i);
  }
  return out;
}

double prior_cost(const IntrinsicsVector& offset, const IntrinsicsVector& prior) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < kIntrinsics; ++i) {
    if (prior(i) > 0.0) sum += 0.5 * std::pow(offset(i) / prior(i), 2);
  }
  return sum;
}

// One Levenberg–Marquardt solve at a fixed σ. False if it does not move from where it stands.
bool solve_bundle(const std::vector<SeenPoints>& views, const IntrinsicsVector& given,
                  const IntrinsicsVector& prior, double sigma_px, BundleState& state) {
  double damping = 1e-6;
  const auto offset_of = [&](const BundleState& s) -> IntrinsicsVector {
    return intrinsics_of(s.camera) - given;
  };
  BundleEquations at = linearize_bundle(views, state, sigma_px, true);
  if (!std::isfinite(at.cost)) return false;
  double cost = at.cost + prior_cost(offset_of(state), prior);
  for (int i = 0; i < kMaxIterations; ++i) {
    const Reduced reduced = reduce(at, offset_of(state), prior, damping);
    const Eigen::LDLT<Matrix12> factor(reduced.information);
    IntrinsicsVector step = factor.solve(reduced.gradient).cwiseProduct(prior);
    if (!step.allFinite()) return false;
    BundleState next = state;
    next.camera = with_intrinsics(state.camera, intrinsics_of(state.camera) + step);
    for (std::size_t v = 0; v < views.size(); ++v) {
      Matrix6d own = at.views[v].own;
      own.diagonal() *= 1.0 + damping;
      const Vector6d move =
          own.ldlt().solve(at.views[v].own_gradient - at.views[v].coupling * step);
      if (!move.allFinite()) return false;
      next.poses[v] = se3_exp(move) * state.poses[v];
    }
    const bool possible = next.camera.fx > 0.0 && next.camera.fy > 0.0;
    const double tried = possible ? linearize_bundle(views, next, sigma_px, false).cost +
                                        prior_cost(offset_of(next), prior)
                                  : std::numeric_limits<double>::infinity();
    if (!(tried <= cost)) {
      damping = std::max(1e-6, 10.0 * damping);
      if (damping > 1e8) return true;
      continue;
    }
    const double gain = cost - tried;
    state = std::move(next);
    cost = tried;
    damping = std::max(1e-9, 0.1 * damping);
    // A hundredth of a nat is far below anything that a test asks for.
    if (gain < 0.01) return true;
    at = linearize_bundle(views, state, sigma_px, true);
  }
  return true;
}

}  // namespace

void add_corners(const std::vector<CornerObservation>& corners, const Rigid3& body_from_board,
                 SeenPoints& to) {
  for (const CornerObservation& c : corners) {
    to.point_m.push_back(body_from_board * Eigen::Vector3d(c.board_m.x(), c.board_m.y(), 0.0));
    to.pixel.push_back(c.pixel);
  }
}

std::optional<BundleFit> fit_bundle(const std::vector<SeenPoints>& views,
                                    const std::vector<Rigid3>& poses, const Camera& camera,
                                    const IntrinsicsVector& prior) {
  BundleState state{camera, poses};
  std::size_t points = 0;
  for (const SeenPoints& view : views) points += view.point_m.size();
  if (points < kFewestPoints) return std::nullopt;
  const IntrinsicsVector given = intrinsics_of(camera);
  const auto free = static_cast<double>((prior.array() > 0.0).count());
  const double freedom =
      2.0 * static_cast<double>(points) - 6.0 * static_cast<double>(views.size()) - free;
  // The first pass bridges whatever the given camera misses by; then σ from the residuals.
  double sigma = 1.0;
  BundleEquations at;
  for (int round = 0; round < 6; ++round) {
    if (!solve_bundle(views, given, prior, sigma, state)) return std::nullopt;
    at = linearize_bundle(views, state, sigma, true);
    if (freedom < 1.0) break;
    const double next = std::max(kFloor_px, std::sqrt(at.squares / freedom));
    const bool settled = std::abs(std::log(next / sigma)) < 0.02;
    sigma = next;
    if (settled) break;
  }
  at = linearize_bundle(views, state, sigma, true);
  const Reduced reduced = reduce(at, IntrinsicsVector::Zero(), prior, 0.0);
  const Eigen::LDLT<Matrix12> factor(reduced.information);
  if (factor.info() != Eigen::Success || !factor.isPositive()) return std::nullopt;
  BundleFit out;
  out.camera = state.camera;
  out.poses = std::move(state.poses);
  out.covariance = prior.asDiagonal() * factor.solve(Matrix12::Identity()) * prior.asDiagonal();
  out.sigma_px = sigma;
  out.freedom = freedom;
  if (!out.covariance.allFinite() || !check(out.camera)) return std::nullopt;
  return out;
}

std::optional<IntrinsicsEvidence> bundle_evidence(const std::vector<SeenPoints>& views,
                                                  const std::vector<Rigid3>& poses,
                                                  const Camera& camera, double sigma_px) {
  BundleState state{camera, poses};
  if (!solve_bundle(views, intrinsics_of(camera), IntrinsicsVector::Zero(), sigma_px, state))
    return std::nullopt;
  const BundleEquations at = linearize_bundle(views, state, sigma_px, true);
  IntrinsicsEvidence out{camera, at.intrinsics, at.gradient};
  for (const View& view : at.views) {
    const Eigen::LDLT<Matrix6d> factor(view.own);
    out.information -= view.coupling.transpose() * factor.solve(view.coupling);
    out.gradient -= view.coupling.transpose() * factor.solve(view.own_gradient);
  }
  if (!out.information.allFinite() || !out.gradient.allFinite()) return std::nullopt;
  return out;
}

}  // namespace lvcalib
