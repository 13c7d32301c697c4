// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/candidate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <boost/math/distributions/fisher_f.hpp>

#include "base/statistics.h"

namespace lvcalib {
namespace {

struct MeanAndError {
  double mean = 0.0;
  double error = 0.0;  // standard error of the mean
};

double total(const std::array<double, kChannels>& squares) {
  return std::accumulate(squares.begin(), squares.end(), 0.0);
}

MeanAndError mean_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0.0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, n > 1.0 ? std::sqrt(squares / (n - 1.0) / n) : HUGE_VAL};
}

// Squared distance of the estimate to the nearest parameters at or above their lowest values, in
// standard deviations, by coordinate descent (the problem is convex and has few parameters).
double beyond_possible(const EffectColumns& columns, const ModelFit& fit) {
  constexpr int kRounds = 50;
  const Eigen::Index p = columns.count();
  const auto lowest = [&](Eigen::Index k) {
    return columns.parameters[static_cast<std::size_t>(k)].lowest;
  };
  const Eigen::VectorXd theta = fit.solution.tail(p);
  bool below = false;
  for (Eigen::Index k = 0; k < p; ++k) below = below || theta(k) < lowest(k);
  if (!below) return 0.0;
  const Eigen::MatrixXd s = information_of_last(fit, p);
  Eigen::VectorXd off(p);  // from the estimate to the point tried
  for (Eigen::Index k = 0; k < p; ++k) off(k) = std::max(theta(k), lowest(k)) - theta(k);
  for (int round = 0; round < kRounds; ++round) {
    for (Eigen::Index k = 0; k < p; ++k) {
      if (!(s(k, k) > 0.0)) continue;
      const double best = off(k) - s.row(k).dot(off) / s(k, k);
      off(k) = std::max(best, lowest(k) - theta(k));
    }
  }
  return off.dot(s * off);
}

// Scenes that say something about an effect, one that shows only where a board faces the beam
// leaves the others as they were, and those of them that are predicted better. The density also
// judges the variances, which one effect in many scenes shrinks for all: a scene whose squares fall
// is predicted better as well.
struct ImprovedScenes {
  std::size_t improved = 0;
  std::size_t speaking = 0;
};

ImprovedScenes improved_scenes(const Candidate& candidate, const DiscoveryOptions& options) {
  ImprovedScenes out;
  for (std::size_t s = 0; s < candidate.scene_gain.size(); ++s) {
    if (std::abs(candidate.scene_gain[s]) < options.speaking_nats) continue;
    ++out.speaking;
    const bool fell =
        s < candidate.scene_squares_fall.size() && candidate.scene_squares_fall[s] > 0;
    out.improved += candidate.scene_gain[s] > 0.0 || fell ? 1 : 0;
  }
  return out;
}

// Where an effect acts. A channel that holds less than a hundredth of a parameter's squared effect
// does not show it: what moves edges moves the intensities of plain print by a trace.
void note_acting(const Linearization& linear, const EffectColumns& c, Candidate& out) {
  constexpr double kTrace = 0.01;
  out.acting_share.fill(0.0);
  for (int k = 0; k < c.count(); ++k) {
    std::array<double, kChannels> squares{};
    for (const Channel channel : kAllChannels)
      squares[static_cast<std::size_t>(channel)] = linear.squares(channel, c.first + k);
    for (const Channel channel : kAllChannels) {
      const auto at = static_cast<std::size_t>(channel);
      if (!(squares[at] > kTrace * total(squares))) continue;
      out.acting_share[at] =
          std::max(out.acting_share[at], linear.acting_share(channel, c.first + k));
      if (channel == Channel::kIntensity &&
          squares[at] > squares[static_cast<std::size_t>(Channel::kBoundary)])
        out.must_show = Channel::kIntensity;
    }
  }
}

Eigen::MatrixXd inverse_root(const Eigen::MatrixXd& m) {
  const Eigen::MatrixXd l = m.llt().matrixL();
  return l.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(m.rows(), m.cols()));
}

}  // namespace

ExtrinsicMove tolerated(const Tolerance& tolerance, const ModelFit& fit) {
  const auto worst = [](const Eigen::Matrix3d& c) {
    return std::sqrt(
        std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(c, Eigen::EigenvaluesOnly)
                          .eigenvalues()(2)));
  };
  const double sigmas = tolerance.sigmas;
  return {
      std::max(tolerance.move.translation_m, sigmas * worst(fit.covariance.topLeftCorner<3, 3>())),
      std::max(tolerance.move.rotation_rad, sigmas * worst(fit.covariance.block<3, 3>(3, 3)))};
}

ExtrinsicMove move_if_omitted(const ModelFit& fit, const Eigen::VectorXd& values, double* kept) {
  const Eigen::Index p = values.size();
  Eigen::MatrixXd h = fit.prior.information;
  h.bottomRightCorner(p, p).setZero();
  for (const SceneTerm& scene : fit.scenes) h += scene.information;
  const Eigen::Index q = h.rows() - p;
  const Eigen::VectorXd cross = h.topRightCorner(q, p) * values;
  const Eigen::VectorXd move = h.topLeftCorner(q, q).ldlt().solve(cross);
  if (kept != nullptr) {
    const double all = values.dot(h.bottomRightCorner(p, p) * values);
    *kept = all > 0.0 ? std::clamp(1.0 - cross.dot(move) / all, 0.0, 1.0) : 0.0;
  }
  return {move.head<3>().norm(), move.segment<3>(3).norm()};
}

// The move is M θ; over θ̂ + L z with |z|² at its 95 % quantile it is at most |M θ̂| + q |M L|.
MoveLimit move_limit(const ModelFit& fit, Eigen::Index p) {
  Eigen::MatrixXd h = fit.prior.information;
  h.bottomRightCorner(p, p).setZero();
  for (const SceneTerm& scene : fit.scenes) h += scene.information;
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

double Candidate::total_gain() const {
  return std::accumulate(scene_gain.begin(), scene_gain.end(), 0.0);
}

double Candidate::total_density() const {
  return std::accumulate(scene_density.begin(), scene_density.end(), 0.0);
}

double Candidate::best_heldout_gain() const {
  return *std::max_element(heldout_gain.begin(), heldout_gain.end());
}

bool Candidate::acts_on_edges_alone() const {
  for (const Channel channel : kAllChannels) {
    const bool acts = acting_share[static_cast<std::size_t>(channel)] > 0.0;
    if (acts != (channel == Channel::kBoundary)) return false;
  }
  return true;
}

Channel Candidate::main_channel() const {
  const auto best = std::max_element(heldout_fall.begin(), heldout_fall.end());
  return static_cast<Channel>(best - heldout_fall.begin());
}

void Candidate::set_heldout(const std::array<double, kChannels>& with,
                            const std::array<double, kChannels>& without,
                            const std::array<double, kChannels>& rows) {
  for (std::size_t k = 0; k < kChannels; ++k) {
    heldout_gain[k] = without[k] > 0.0 ? 1.0 - with[k] / without[k] : 0.0;
    heldout_fall[k] = without[k] - with[k];
  }
  const auto share_of = [&](std::size_t k) {
    const double unexplained = without[k] - rows[k];
    return unexplained > rows[k] ? heldout_fall[k] / unexplained : 1.0;
  };
  explained_in = main_channel();
  explained_share = share_of(static_cast<std::size_t>(explained_in));
  const auto acts = [](double share) { return share > 0.0; };
  const auto only = std::find_if(acting_share.begin(), acting_share.end(), acts);
  if (std::count_if(acting_share.begin(), acting_share.end(), acts) != 1) return;
  const double share = share_of(static_cast<std::size_t>(only - acting_share.begin()));
  if (share >= explained_share) return;
  explained_share = share;
  explained_in = static_cast<Channel>(only - acting_share.begin());
}

std::array<double, kChannels> row_counts(const Linearization& linear) {
  std::array<double, kChannels> out{};
  for (const SceneProducts& scene : linear.scenes) {
    for (std::size_t k = 0; k < kChannels; ++k) out[k] += scene.rows[k];
  }
  return out;
}

void append_columns(const EffectColumns& columns, const Eigen::VectorXd* in_use,
                    ColumnSubset& subset) {
  std::size_t run = subset.columns.size();
  for (const std::size_t count : columns.zero_sums) {
    subset.zero_sums.emplace_back(run, count);
    run += count;
  }
  for (int k = 0; k < columns.count(); ++k) {
    subset.columns.push_back(columns.first + k);
    subset.prior_sigma.push_back(columns.parameters[static_cast<std::size_t>(k)].prior_sigma);
    subset.prior_mean.push_back(in_use != nullptr ? -(*in_use)(k) : 0.0);
  }
}

std::vector<std::array<double, kChannels>> heldout_squares(const Linearization& linear,
                                                           const ModelFit& fit) {
  std::vector<std::array<double, kChannels>> out;
  for (std::size_t s = 0; s < linear.scenes.size(); ++s)
    out.push_back(squares_at(linear, s, fit.subset, solution_without(fit, s), fit.variances));
  return out;
}

Reference make_reference(const Linearization& linear, const ColumnSubset& subset,
                         const ModelVariances& start, const MixedModelOptions& options) {
  Reference out;
  out.subset = subset;
  out.fit = fit_model(linear, subset, start, options);
  for (std::size_t s = 0; s < linear.scenes.size(); ++s)
    out.density.push_back(predictive_log_density(out.fit, s));
  out.heldout = heldout_squares(linear, out.fit);
  return out;
}

Candidate evaluate_candidate(const Linearization& linear, const Reference& reference,
                             std::size_t columns, const Tolerance& tolerance,
                             const MixedModelOptions& options) {
  Candidate out;
  out.columns = columns;
  const EffectColumns& c = linear.columns.list()[columns];
  ColumnSubset subset = reference.subset;
  append_columns(c, nullptr, subset);
  out.fit = fit_model(linear, subset, reference.fit.variances, options);
  out.p_value = f_test(out.fit, c.count());
  out.tolerance = tolerated(tolerance, reference.fit);
  out.limit = move_limit(out.fit, c.count());
  out.beyond_possible = beyond_possible(c, out.fit);
  std::array<double, kChannels> with{};
  std::array<double, kChannels> without{};
  const auto heldout = heldout_squares(linear, out.fit);
  for (std::size_t s = 0; s < linear.scenes.size(); ++s) {
    out.scene_density.push_back(predictive_log_density(out.fit, s));
    out.scene_gain.push_back(out.scene_density[s] - reference.density[s]);
    out.scene_squares_fall.push_back(total(reference.heldout[s]) - total(heldout[s]));
    for (std::size_t k = 0; k < kChannels; ++k) {
      with[k] += heldout[s][k];
      without[k] += reference.heldout[s][k];
    }
  }
  note_acting(linear, c, out);
  out.set_heldout(with, without, row_counts(linear));
  const Vector6d move = out.fit.solution.head<6>() - reference.fit.solution.head<6>();
  const Matrix6d covariance = reference.fit.covariance.topLeftCorner<6, 6>();
  for (int k = 0; k < 6; ++k) {
    out.extrinsic_move_sigmas =
        std::max(out.extrinsic_move_sigmas, std::abs(move(k)) / std::sqrt(covariance(k, k)));
  }
  return out;
}

Eigen::MatrixXd information_of_last(const ModelFit& fit, Eigen::Index p) {
  Eigen::MatrixXd h = fit.prior.information;
  h.bottomRightCorner(p, p).setZero();
  for (const SceneTerm& scene : fit.scenes) h += scene.information;
  const Eigen::Index q = h.rows() - p;
  return h.bottomRightCorner(p, p) -
         h.bottomLeftCorner(p, q) * h.topLeftCorner(q, q).ldlt().solve(h.topRightCorner(q, p));
}

double f_test(double squares, Eigen::Index p, std::size_t scenes) {
  const double f = squares / static_cast<double>(p);
  const double freedom = std::max(1.0, 3.0 * static_cast<double>(scenes) - 6.0);
  if (!(f > 0.0) || !std::isfinite(f)) return 1.0;
  return boost::math::cdf(
      boost::math::complement(boost::math::fisher_f(static_cast<double>(p), freedom), f));
}

double f_test(const ModelFit& fit, Eigen::Index p) {
  const Eigen::VectorXd theta = fit.solution.tail(p);
  const Eigen::MatrixXd s = information_of_last(fit, p);
  return f_test(theta.dot(s * theta), p, fit.scenes.size());
}

bool is_gain(const std::vector<double>& per_scene) {
  const MeanAndError gain = mean_of(per_scene);
  return gain.mean > gain.error;
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
  return std::clamp(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(share).eigenvalues().maxCoeff(),
                    0.0, 1.0);
}

namespace {

// Squared: two standard deviations, which one right estimate in twenty is off by.
constexpr double kImpossible = 4.0;
// What one scene alone shows may be that scene's own fault.
constexpr double kFewestImproved = 2.0;

// That it is there, however small.
std::vector<Criterion> existence(const Candidate& candidate, std::size_t tried,
                                 const DiscoveryOptions& options) {
  const double searched = static_cast<double>(std::max<std::size_t>(tried, 1));
  const MeanAndError gain = mean_of(candidate.scene_gain);
  const ImprovedScenes scenes = improved_scenes(candidate, options);
  const auto improved = static_cast<double>(scenes.improved);
  // Just above one: a mean of exactly its standard error is none.
  constexpr double kMoreThanOne = 1.0 + 1e-12;
  return {{"p_value", candidate.p_value * searched, options.false_alarm, true},
          {"mean_gain", gain.mean / std::max(gain.error, 1e-300), kMoreThanOne},
          {"total_gain", candidate.total_gain(), std::log(searched)},
          {"scenes_improved",
           scenes.speaking > 0 ? improved / static_cast<double>(scenes.speaking) : 0.0,
           options.scenes_improved},
          {"two_scenes", improved, kFewestImproved}};
}

// The largest fall of held-out squares over the least that counts. An effect that acts on few rows
// is asked for the same fall on those.
double held_out(const Candidate& candidate, std::size_t scenes, const DiscoveryOptions& options) {
  const double least = scenes <= 3 ? options.min_gain_few_scenes : options.min_gain;
  double out = candidate.must_show
                   ? -HUGE_VAL
                   : candidate.extrinsic_move_sigmas / std::max(1e-12, options.min_extrinsic_move);
  for (std::size_t k = 0; k < kChannels; ++k) {
    if (candidate.must_show && static_cast<std::size_t>(*candidate.must_show) != k) continue;
    const double share = candidate.acting_share[k];
    if (share > 0.0)
      out = std::max(out, candidate.heldout_gain[k] / std::max(1e-12, least * share));
  }
  return out;
}

bool all_hold(const std::vector<Criterion>& criteria) {
  return std::all_of(criteria.begin(), criteria.end(),
                     [](const Criterion& c) { return c.holds(); });
}

}  // namespace

bool Candidate::possible() const {
  return beyond_possible <= kImpossible;
}

std::vector<Criterion> criteria_of(const Candidate& candidate, std::size_t tried,
                                   std::size_t scenes, const DiscoveryOptions& options) {
  std::vector<Criterion> out = existence(candidate, tried, options);
  out.push_back({"possible", candidate.beyond_possible, kImpossible, true});
  // Where much is wrong, what explains a little of it stands in for something else.
  out.push_back({"explained", candidate.explained_share, options.min_explained});
  out.push_back({"held_out", held_out(candidate, scenes, options), 1.0});
  out.push_back(
      {"not_contradicted", candidate.contradiction == Contradiction::kNone ? 1.0 : 0.0, 1.0});
  return out;
}

bool is_sure(const Candidate& candidate, std::size_t tried, const DiscoveryOptions& options) {
  return all_hold(existence(candidate, tried, options));
}

bool is_accepted(const Candidate& candidate, std::size_t tried, std::size_t scenes,
                 const DiscoveryOptions& options) {
  return all_hold(criteria_of(candidate, tried, scenes, options));
}

double correlation_of(const Linearization& linear, const Reference& reference, std::size_t a,
                      std::size_t b) {
  const EffectColumns& ca = linear.columns.list()[a];
  const EffectColumns& cb = linear.columns.list()[b];
  ColumnSubset subset = reference.subset;
  append_columns(ca, nullptr, subset);
  append_columns(cb, nullptr, subset);
  const ModelFit fit = fit_model(linear, subset, reference.fit.variances, {.rounds = 0});
  const Eigen::MatrixXd s = information_of_last(fit, ca.count() + cb.count());
  const Eigen::MatrixXd aa = s.topLeftCorner(ca.count(), ca.count());
  const Eigen::MatrixXd bb = s.bottomRightCorner(cb.count(), cb.count());
  if (aa.diagonal().minCoeff() <= 0.0 || bb.diagonal().minCoeff() <= 0.0) return 0.0;
  const Eigen::MatrixXd ab =
      inverse_root(aa) * s.topRightCorner(ca.count(), cb.count()) * inverse_root(bb).transpose();
  if (!ab.allFinite()) return 0.0;
  return std::min(1.0, Eigen::JacobiSVD<Eigen::MatrixXd>(ab).singularValues()(0));
}

bool indistinguishable(const Candidate& a, const Candidate& b) {
  std::vector<double> difference;
  for (std::size_t s = 0; s < a.scene_density.size(); ++s)
    difference.push_back(a.scene_density[s] - b.scene_density[s]);
  const MeanAndError d = mean_of(difference);
  return std::abs(d.mean) < d.error;
}

}  // namespace lvcalib
