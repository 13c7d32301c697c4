// SPDX-License-Identifier: BSD-3-Clause
#include "solve/fit_inference.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/SVD>

#include "base/statistics.h"
#include "base/symmetric.h"

namespace lvcalib {
namespace {

// Information of all scenes, and of the priors but those of the last p unknowns.
Eigen::MatrixXd information_but_prior(const ModelFit& fit, Eigen::Index p) {
  Eigen::MatrixXd h = fit.prior.information;
  h.bottomRightCorner(p, p).setZero();
  for (const SceneTerm& scene : fit.scenes) h += scene.information;
  return h;
}

// What the other unknowns take over of the last ones' effect.
struct Absorbed {
  Eigen::VectorXd cross;  // Of their information with the last ones, times these values.
  Eigen::VectorXd by;     // By how much they move.
};

Absorbed absorbed(const Eigen::MatrixXd& h, const Eigen::VectorXd& values) {
  const Eigen::Index p = values.size();
  const Eigen::Index q = h.rows() - p;
  Absorbed out;
  out.cross = h.topRightCorner(q, p) * values;
  out.by = h.topLeftCorner(q, q).ldlt().solve(out.cross);
  return out;
}

}  // namespace

ExtrinsicMove tolerated(const Tolerance& tolerance, const ModelFit& fit) {
  const double sigmas = tolerance.sigmas;
  return {std::max(tolerance.move.translation_m,
                   sigmas * largest_sigma(fit.covariance.topLeftCorner<3, 3>())),
          std::max(tolerance.move.rotation_rad,
                   sigmas * largest_sigma(fit.covariance.block<3, 3>(3, 3)))};
}

ExtrinsicMove move_if_omitted(const ModelFit& fit, const Eigen::VectorXd& values) {
  const Eigen::VectorXd move = absorbed(information_but_prior(fit, values.size()), values).by;
  return {move.head<3>().norm(), move.segment<3>(3).norm()};
}

double unabsorbed_share(const ModelFit& fit, const Eigen::VectorXd& values) {
  const Eigen::Index p = values.size();
  const Eigen::MatrixXd h = information_but_prior(fit, p);
  const Absorbed other = absorbed(h, values);
  const double all = values.dot(h.bottomRightCorner(p, p) * values);
  return all > 0.0 ? std::clamp(1.0 - other.cross.dot(other.by) / all, 0.0, 1.0) : 0.0;
}

// The move is M θ; over θ̂ + L z with |z|² at its 95 % quantile it is at most |M θ̂| + q |M L|.
MoveLimit move_limit(const ModelFit& fit, Eigen::Index p) {
  const Eigen::MatrixXd h = information_but_prior(fit, p);
  const Eigen::Index q = h.rows() - p;
  const Eigen::MatrixXd by =
      h.topLeftCorner(q, q).ldlt().solve(Eigen::MatrixXd(h.topRightCorner(q, p)));
  const Eigen::VectorXd theta = fit.solution.tail(p);
  const Eigen::MatrixXd root = fit.covariance.bottomRightCorner(p, p).llt().matrixL();
  const double quantile = p == 1 ? kUpper95 : std::sqrt(chi_square_gate(static_cast<int>(p), 0.05));
  const auto unknown = [&](const Eigen::MatrixXd& rows) {
    const Eigen::MatrixXd spread = rows * root;
    return quantile * Eigen::JacobiSVD<Eigen::MatrixXd>(spread).singularValues()(0);
  };
  MoveLimit out;
  out.unknown = {unknown(by.topRows<3>()), unknown(by.middleRows<3>(3))};
  out.most = {(by.topRows<3>() * theta).norm() + out.unknown.translation_m,
              (by.middleRows<3>(3) * theta).norm() + out.unknown.rotation_rad};
  return out;
}

Eigen::MatrixXd information_of_last(const ModelFit& fit, Eigen::Index p) {
  const Eigen::MatrixXd h = information_but_prior(fit, p);
  const Eigen::Index q = h.rows() - p;
  return h.bottomRightCorner(p, p) -
         h.bottomLeftCorner(p, q) * h.topLeftCorner(q, q).ldlt().solve(h.topRightCorner(q, p));
}

double f_test(double squares, Eigen::Index p, std::size_t scenes) {
  const double f = squares / static_cast<double>(p);
  const double freedom = std::max(1.0, 3.0 * static_cast<double>(scenes) - 6.0);
  if (!(f > 0.0) || !std::isfinite(f)) return 1.0;
  return f_tail(static_cast<int>(p), freedom, f);
}

double f_test(const ModelFit& fit, Eigen::Index p) {
  const Eigen::VectorXd theta = fit.solution.tail(p);
  const Eigen::MatrixXd s = information_of_last(fit, p);
  return f_test(theta.dot(s * theta), p, fit.scenes.size());
}

double determined_share(const ModelFit& fit, Eigen::Index first, Eigen::Index count) {
  // Priors of the others keep them determined, but must not lend what the data do not have.
  constexpr double kFaint = 1e-6;
  Eigen::MatrixXd h = kFaint * fit.prior.information;
  h.block(first, first, count, count).setZero();
  for (const SceneTerm& scene : fit.scenes) h += scene.information;
  std::vector<Eigen::Index> own;
  std::vector<Eigen::Index> rest;
  for (Eigen::Index k = 0; k < h.rows(); ++k)
    (k >= first && k < first + count ? own : rest).push_back(k);
  const Eigen::MatrixXd raw = h(own, own);
  const Eigen::MatrixXd cross = h(rest, own);
  const Eigen::MatrixXd left =
      raw - cross.transpose() * Eigen::MatrixXd(h(rest, rest)).ldlt().solve(cross);
  if (!(raw.diagonal().maxCoeff() > 0.0)) return 0.0;
  const Eigen::VectorXd scale =
      raw.diagonal().cwiseMax(1e-12 * raw.diagonal().maxCoeff()).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd share = scale.asDiagonal() * left * scale.asDiagonal();
  return std::clamp(axes_of(share).values.maxCoeff(), 0.0, 1.0);
}

MeanAndError mean_and_error(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0.0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, n > 1.0 ? std::sqrt(squares / (n - 1.0) / n) : HUGE_VAL};
}

bool is_gain(const std::vector<double>& per_scene) {
  const MeanAndError gain = mean_and_error(per_scene);
  return gain.mean > gain.error;
}

}  // namespace lvcalib
