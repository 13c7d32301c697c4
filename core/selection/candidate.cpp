// SPDX-License-Identifier: BSD-3-Clause
#include "selection/candidate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/SVD>

#include "base/parallel.h"
#include "base/statistics.h"

namespace lvcalib {
namespace {

double total(const std::array<double, kChannels>& squares) {
  return std::accumulate(squares.begin(), squares.end(), 0.0);
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
  std::size_t informative = 0;
};

ImprovedScenes improved_scenes(const Candidate& candidate, const DiscoveryOptions& options) {
  ImprovedScenes out;
  for (std::size_t s = 0; s < candidate.scene_gain.size(); ++s) {
    if (std::abs(candidate.scene_gain[s]) < options.informative_nats) continue;
    ++out.informative;
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

std::vector<std::array<double, kChannels>> heldout_squares(const Linearization& linear,
                                                           const ModelFit& fit, int threads) {
  std::vector<std::array<double, kChannels>> out(linear.scenes.size());
  parallel_for(out.size(), threads, [&](std::size_t s) {
    out[s] = squares_at(linear, s, fit.subset, solution_without(fit, s), fit.variances);
  });
  return out;
}

HeldoutScenes heldout_scenes(const MeasurementTable& table, const Linearization& linear,
                             const Reference& reference) {
  HeldoutScenes out(linear.scenes.size());
  for (std::size_t s = 0; s < out.size(); ++s) {
    out[s].squares = reference.heldout[s];
    for (std::size_t k = 0; k < kChannels; ++k) out[s].rows[k] = linear.scenes[s].rows[k];
  }
  const auto add = [&](Channel channel, int scene, double sigma) {
    out[static_cast<std::size_t>(scene)].weight[static_cast<std::size_t>(channel)] +=
        1.0 / (sigma * sigma);
  };
  for (const RangeRow& row : table.range) add(Channel::kRange, row.beam.scene, row.sigma_m);
  for (const BoundaryRow& row : table.boundary)
    add(Channel::kBoundary, row.beam.scene, row.sigma_m);
  for (const IntensityRow& row : table.intensity)
    add(Channel::kIntensity, row.beam.scene, row.sigma);
  for (const CornerRow& row : table.corner) add(Channel::kCorner, row.scene, row.sigma_px);
  return out;
}

double total_squares(const HeldoutScenes& scenes, Channel channel) {
  double sum = 0.0;
  for (const HeldoutScene& scene : scenes) sum += scene.squares[static_cast<std::size_t>(channel)];
  return sum;
}

bool predicts_worse(const HeldoutScenes& before, const HeldoutScenes& after, double least) {
  const auto worse = [&](std::array<double, kChannels> HeldoutScene::*per) {
    std::vector<double> loss;
    double rows = 0.0;
    for (std::size_t s = 0; s < before.size(); ++s) {
      loss.push_back(0.0);
      for (std::size_t k = 0; k < kChannels; ++k) {
        const double was = before[s].squares[k] / (before[s].*per)[k];
        const double is = after[s].squares[k] / (after[s].*per)[k];
        if (!(was > 0.0) || !(is > 0.0)) continue;  // Or no rows.
        loss.back() += before[s].rows[k] * std::log(is / was);
        rows += before[s].rows[k];
      }
    }
    return std::accumulate(loss.begin(), loss.end(), 0.0) > least * rows && is_gain(loss);
  };
  return worse(&HeldoutScene::rows) && worse(&HeldoutScene::weight);
}

Reference make_reference(const Linearization& linear, const ColumnSubset& subset,
                         const ModelVariances& start, const MixedModelOptions& options) {
  Reference out;
  out.subset = subset;
  out.fit = fit_model(linear, subset, start, options);
  for (std::size_t s = 0; s < linear.scenes.size(); ++s)
    out.density.push_back(predictive_log_density(out.fit, s));
  out.heldout = heldout_squares(linear, out.fit, options.threads);
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
  const auto heldout = heldout_squares(linear, out.fit, options.threads);
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

namespace {

// Squared: two standard deviations, which one right estimate in twenty is off by.
constexpr double kImpossible = 4.0;
// What one scene alone shows may be that scene's own fault.
constexpr double kFewestImproved = 2.0;

// That it is there, however small.
std::vector<Criterion> existence(const Candidate& candidate, std::size_t tried,
                                 const DiscoveryOptions& options) {
  const double searched = static_cast<double>(std::max<std::size_t>(tried, 1));
  const MeanAndError gain = mean_and_error(candidate.scene_gain);
  const ImprovedScenes scenes = improved_scenes(candidate, options);
  const auto improved = static_cast<double>(scenes.improved);
  // Just above one: a mean of exactly its standard error is none.
  constexpr double kMoreThanOne = 1.0 + 1e-12;
  return {{"p_value", candidate.p_value * searched, options.false_alarm, true},
          {"mean_gain", gain.mean / std::max(gain.error, 1e-300), kMoreThanOne},
          {"total_gain", candidate.total_gain(), std::log(searched)},
          {"scenes_improved",
           scenes.informative > 0 ? improved / static_cast<double>(scenes.informative) : 0.0,
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
  constexpr std::array<std::pair<const char*, Contradiction>, 5> kAgainst{
      {{"prints_agree", Contradiction::kPrints},
       {"edges_trusted", Contradiction::kLevels},
       {"beside_curve", Contradiction::kCurve},
       {"beside_place", Contradiction::kPlace},
       {"scenes_agree", Contradiction::kScenes}}};
  for (const auto& [name, by] : kAgainst)
    out.push_back({name, candidate.contradiction == by ? 0.0 : 1.0, 1.0});
  return out;
}

Message reason_of(const Criterion& criterion) {
  static const std::map<std::string, Message> reasons = {
      {"p_value", Message("chance must not reach it, among all effects and shapes tried")},
      {"mean_gain",
       Message("scenes held out must be predicted better by more than they differ among each "
               "other")},
      {"total_gain", Message("the best of so many candidates gains something by chance alone")},
      {"scenes_improved",
       Message("one scene with all the leverage must not decide for the others")},
      {"two_scenes", Message("what shows in one scene only may be that scene's own fault")},
      {"possible", Message("no device has an effect of such a size: it stands in for another")},
      {"explained",
       Message("where much is wrong, what explains a little of it stands in for something else")},
      {"held_out",
       Message("it must make the residuals of scenes held out smaller, or move the extrinsic")},
      {"prints_agree",
       Message("white and black print must tell the same about an effect of either")},
      {"edges_trusted",
       Message(
           "edges are found in intensities: where these are doubted, edges alone tell nothing")},
      {"beside_curve",
       Message("a curve over one covariate predicts far better, and beside it the effect must have "
               "something left to say")},
      {"beside_place",
       Message("something at one place predicts better, and the effect must take away half of it")},
      {"scenes_agree",
       Message(
           "tried in the model, it must not predict scenes held out worse or come to nothing")}};
  const auto found = reasons.find(criterion.name);
  return found == reasons.end() ? Message() : found->second;
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
  const MeanAndError d = mean_and_error(difference);
  return std::abs(d.mean) < d.error;
}

}  // namespace lvcalib
