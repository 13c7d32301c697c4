// SPDX-License-Identifier: BSD-3-Clause
#include "selection/effect_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "base/parallel.h"
#include "base/statistics.h"
#include "model/beam_blur.h"
#include "model/residuals.h"
#include "model/sensor_errors.h"

namespace lvcalib {
namespace {

constexpr std::size_t kFinalists = 12;  // candidates whose variances are settled fully
constexpr std::size_t kFewShapes = 8;   // more than these are first sieved on the residuals
constexpr std::size_t kSievedShapes = 3;
// A displacement of so many standard deviations leaves a hundredth of itself to the next.
constexpr double kStands = 0.1;
constexpr std::size_t kRefitted = 3;  // candidates that get a full refit when they need one

// Keeps the columns just appended where they are: their increments are known to be zero.
void hold_last(const EffectColumns& columns, ColumnSubset& subset) {
  const std::size_t first = subset.columns.size() - columns.parameters.size();
  std::erase_if(subset.zero_sums, [&](const auto& run) { return run.first >= first; });
  for (std::size_t k = 0; k < columns.parameters.size(); ++k) {
    subset.prior_sigma[first + k] = 1e-6 * columns.parameters[k].size_of_interest;
    subset.prior_mean[first + k] = 0.0;
  }
}

// Takes an effect in use out of a model about its values: its increment is known to undo them.
// Columns of effects in use come first.
void hold_at_zero(const EffectColumns& columns, const Eigen::VectorXd& values,
                  ColumnSubset& subset) {
  for (int p = 0; p < columns.count(); ++p) {
    const auto at = static_cast<std::size_t>(columns.first + p);
    subset.prior_sigma[at] =
        1e-6 * columns.parameters[static_cast<std::size_t>(p)].size_of_interest;
    subset.prior_mean[at] = -values(p);
  }
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

void sort_best_first(std::vector<Candidate>& candidates) {
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.total_density() > b.total_density(); });
}

}  // namespace

EffectSearch::EffectSearch(const MeasurementTable& table, ModelState state,
                           const DiscoveryOptions& options, const RunContext& context)
    : EffectSearch(table, std::move(state), {}, options, context) {}

EffectSearch::EffectSearch(const MeasurementTable& table, ModelState state,
                           std::vector<EffectInUse> in_use, const DiscoveryOptions& options,
                           const RunContext& context)
    : base_(&table),
      table_(&table),
      memory_(table),
      state_(std::move(state)),
      options_(&options),
      context_(context),
      in_use_(std::move(in_use)),
      blur_{beam_blur(), 0.0, Eigen::VectorXd::Zero(3)} {
  std::copy_n(table.structure_variances.begin(),
              std::min(table.structure_variances.size(), variances_.group.size()),
              variances_.group.begin());
  refit();
}

std::vector<EffectInUse> EffectSearch::model() const {
  std::vector<EffectInUse> out = in_use_;
  if (sees_print()) out.push_back(blur_);
  return out;
}

std::vector<EffectInUse> EffectSearch::fitted() const {
  std::vector<EffectInUse> out = model();
  for (const SensorError& error : sensor_) out.push_back(error.use);
  return out;
}

std::optional<MeasuredBlur> EffectSearch::measured_blur() const {
  if (!sees_print() || reference_.fit.covariance.rows() == 0) return std::nullopt;
  const Eigen::Index at = blur_place(in_use_);
  const Eigen::Matrix2d& blur = state_.beam.blur_rad2;
  return MeasuredBlur{{blur(0, 0), blur(0, 1), blur(1, 1)},
                      reference_.fit.covariance.block<3, 3>(at, at)};
}

EffectColumnsList EffectSearch::own_columns() const {
  EffectColumnsList columns;
  for (const EffectInUse& use : fitted()) columns.add(use.effect, use.shape, table());
  return columns;
}

ColumnSubset EffectSearch::own_subset(const EffectColumnsList& columns,
                                      const std::optional<OtherColumns>& other) const {
  ColumnSubset subset;
  for (std::size_t k = 0; k < in_use_.size(); ++k) {
    if (other && other->of == k) {
      append_columns(columns.list()[other->columns], nullptr, subset);
      continue;
    }
    append_columns(columns.list()[k], &in_use_[k].values, subset);
    if (in_use_[k].held) hold_last(columns.list()[k], subset);
  }
  std::size_t next = in_use_.size();
  if (sees_print()) append_columns(columns.list()[next++], &blur_.values, subset);
  for (const SensorError& error : sensor_) {
    const EffectColumns& own = columns.list()[next++];
    append_columns(own, &error.use.values, subset);
    std::fill_n(subset.prior_sigma.rbegin(), own.count(), std::sqrt(error.variance));
  }
  return subset;
}

void EffectSearch::add(const EffectPtr& effect, double shape) {
  const auto parameters = effect->parameters(table());
  // A ranking has linearised the model with it: its own columns come first.
  const auto& list = linear_.columns.list();
  std::size_t candidate = own_count();
  const auto is_it = [&](const EffectColumns& c) {
    return c.effect == effect && c.shape == shape && !c.print_contrast;
  };
  while (candidate < list.size() && !is_it(list[candidate])) ++candidate;
  std::vector<std::size_t> columns(own_count());
  std::iota(columns.begin(), columns.end(), std::size_t{0});
  columns.insert(columns.begin() + static_cast<std::ptrdiff_t>(in_use_.size()), candidate);
  in_use_.push_back(
      {effect, shape, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters.size()))});
  if (at_ == At::kLinear && candidate < list.size()) {
    refit_from(picked(linear_, columns));
  } else {
    refit();
  }
}

void EffectSearch::remove(std::size_t k) {
  in_use_.erase(in_use_.begin() + static_cast<std::ptrdiff_t>(k));
  refit();
}

void EffectSearch::replace(std::size_t k, const Swap& swap) {
  move(swap.step, 1.0);
  const auto count = static_cast<Eigen::Index>(swap.effect->parameters(table()).size());
  in_use_[k] = {swap.effect, swap.shape, swap.step.solution.tail(count)};
  refit();
}

std::vector<EffectSearch::Swap> EffectSearch::swaps(std::size_t k,
                                                    const std::vector<EffectPtr>& effects) const {
  EffectColumnsList columns = own_columns();
  const std::size_t first = columns.list().size();
  for (const EffectPtr& effect : effects) {
    for (const double shape : shapes_worth_trying(*effect)) columns.add(effect, shape, table());
  }
  const Linearization linear = linearized(model(), columns);
  if (context_.stopped()) return {};
  const Reference as_it_is = make_reference(linear, own_subset(columns), variances_, how());
  std::vector<Swap> tried(columns.list().size() - first);
  parallel_for(tried.size(), context_.thread_count(), [&](std::size_t at) {
    if (context_.stopped()) return;
    const EffectColumns& c = columns.list()[first + at];
    ColumnSubset subset = own_subset(columns);
    hold_at_zero(columns.list()[k], in_use_[k].values, subset);
    append_columns(c, nullptr, subset);
    Reference with = make_reference(linear, subset, variances_, {});
    tried[at] = {c.effect, c.shape, std::move(with.density), std::move(with.fit)};
    for (std::size_t s = 0; s < tried[at].gain.size(); ++s)
      tried[at].gain[s] -= as_it_is.density[s];
  });
  if (context_.stopped()) return {};
  std::vector<Swap> out;
  for (Swap& swap : tried) {
    if (out.empty() || out.back().effect != swap.effect) {
      out.push_back(std::move(swap));
    } else if (sum_of(swap.gain) > sum_of(out.back().gain)) {
      out.back() = std::move(swap);
    }
  }
  return out;
}

void EffectSearch::refit() {
  refit_from(linearized(model(), own_columns()));
}

void EffectSearch::refit_from(Linearization start) {
  constexpr int kSteps = 15;
  joint_covariance_.reset();
  shape_sigmas_.clear();
  with_slopes_.reset();
  ranked_ = false;
  linear_ = std::move(start);
  at_ = At::kLinear;
  for (int step = 0; step < kSteps && !context_.stopped(); ++step) {
    reference_ = make_reference(linear_, own_subset(linear_.columns), variances_, how());
    variances_ = reference_.fit.variances;
    const Eigen::VectorXd sigma = reference_.fit.covariance.diagonal().cwiseSqrt();
    const double size = (reference_.fit.solution.cwiseAbs().array() / sigma.array()).maxCoeff();
    if (size <= kStands) {
      at_ = move(reference_.fit, 1.0) ? At::kFit : At::kBeyond;
      return;
    }
    const Descent descent = descend(size);
    if (descent == Descent::kNone) return;
    if (descent == Descent::kLittle) break;
  }
  if (!context_.stopped())
    reference_ = make_reference(linear_, own_subset(linear_.columns), variances_, how());
}

Linearization EffectSearch::linear_here() const {
  if (at_ == At::kLinear) return linear_;
  // A tenth of a standard deviation further derivatives are the same.
  if (at_ == At::kFit) return stepped(linear_, reference_.fit);
  return linearized(fitted(), own_columns());
}

ModelFit EffectSearch::fit_as_it_stands(const Linearization& linear,
                                        const ColumnSubset& subset) const {
  return stated_ ? fit_stated(linear, subset, *stated_, context_.thread_count())
                 : fit_model(linear, subset, variances_, how(0));
}

std::optional<EffectSearch> EffectSearch::as_stated() const {
  EffectSearch out(*this);
  for (std::size_t k = 0; k < table().sensor_variances.size(); ++k) {
    if (!(table().sensor_variances[k] > kAbsentSensorError)) continue;
    const EffectPtr error = sensor_error(k);
    const auto count = static_cast<Eigen::Index>(error->parameters(table()).size());
    out.sensor_.push_back(
        {{error, 0.0, Eigen::VectorXd::Zero(count)}, table().sensor_variances[k]});
  }
  if (out.sensor_.empty() && !moves_boards(variances_)) return std::nullopt;
  out.settle();
  return out;
}

void EffectSearch::settle() {
  constexpr int kSteps = 15;           // As in refit(); two or three are usual.
  constexpr int kVarianceRounds = 12;  // Per step, as in the joint solve; they go on in the next.
  const int threads = context_.thread_count();
  stated_.reset();
  joint_covariance_.reset();
  if (!sensor_.empty()) with_slopes_.reset();
  linear_ = sensor_.empty() ? linear_here() : linearized(fitted(), own_columns());
  at_ = At::kLinear;
  for (int step = 0; step < kSteps && !context_.stopped(); ++step) {
    for (int round = 0; round < kVarianceRounds; ++round) {
      reference_.subset = own_subset(linear_.columns);
      stated_ = stated_variances(linear_, reference_.subset, stated_ ? stated_->motion : variances_,
                                 threads);
      reference_.fit = fit_stated(linear_, reference_.subset, *stated_, threads);
      if (!update_sensor_variances()) break;
    }
    const Eigen::VectorXd sigma = reference_.fit.covariance.diagonal().cwiseSqrt();
    const double size = (reference_.fit.solution.cwiseAbs().array() / sigma.array()).maxCoeff();
    if (size <= kStands) {
      at_ = move(reference_.fit, 1.0) ? At::kFit : At::kBeyond;
      break;
    }
    with_slopes_.reset();
    if (descend(size) == Descent::kNone) break;
  }
  if (!shape_sigmas_.empty()) estimate_joint_covariance();
}

// An effect in the model may explain what the joint solve put down to the sensor: its variances are
// then estimated again, by MacKay's fixed point as all others. Without effects they are the joint
// solve's. Whether one has moved.
bool EffectSearch::update_sensor_variances() {
  constexpr double kMoved = 0.03;  // Of a logarithm, as in the joint solve.
  constexpr double kMost = 100.0;  // In one round, either way.
  if (in_use_.empty() || sensor_.empty()) return false;
  const ModelFit& fit = reference_.fit;
  Eigen::MatrixXd information = fit.prior.information;
  for (const SceneTerm& scene : fit.scenes) information += scene.information;
  const Eigen::VectorXd known =
      information.ldlt()
          .solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()))
          .diagonal();
  bool moved = false;
  Eigen::Index at = fit.solution.size();
  for (auto error = sensor_.rbegin(); error != sensor_.rend(); ++error) {
    const Eigen::Index n = error->use.values.size();
    at -= n;
    const double squares = (error->use.values + fit.solution.segment(at, n)).squaredNorm();
    const double determined = static_cast<double>(n) - known.segment(at, n).sum() / error->variance;
    if (!(determined > 0.0)) continue;
    const double next = std::max(
        kAbsentSensorError,
        std::clamp(squares / determined, error->variance / kMost, error->variance * kMost));
    moved = moved || std::abs(std::log(next / error->variance)) > kMoved;
    error->variance = next;
  }
  return moved;
}

// A print is seen through a blur of millimetres: far from linear in what moves it. Steps that do
// not lower what is fitted are halved, down to the size that counts as none. What effects do is
// known to first order, so that steps of some tenths of a standard deviation may lead nowhere.
EffectSearch::Descent EffectSearch::descend(double size) {
  constexpr double kSmall = 0.5;   // Steps of this size were seen to lower nothing however short.
  constexpr double kLittle = 0.1;  // A third of a standard deviation, squared.
  const ModelState state = state_;
  const std::vector<EffectInUse> in_use = in_use_;
  const std::vector<SensorError> sensor = sensor_;
  const ModelVariances& weights = reference_.fit.variances;
  const double before = misfit(linear_, reference_.subset, weights, context_.thread_count());
  for (double share = 1.0; share * size > kStands; share *= 0.5) {
    move(reference_.fit, share);
    Linearization next = linearized(fitted(), own_columns());
    if (context_.stopped()) return Descent::kNone;
    const double after = misfit(next, own_subset(next.columns), weights, context_.thread_count());
    if (after < before) {
      linear_ = std::move(next);
      return size < kSmall && before - after < kLittle ? Descent::kLittle : Descent::kOn;
    }
    state_ = state;
    in_use_ = in_use;
    sensor_ = sensor;
    if (size < kSmall) break;
  }
  return Descent::kNone;
}

// By a share of a fit's solution.
bool EffectSearch::move(const ModelFit& fit, double share) {
  const Eigen::VectorXd x = share * fit.solution;
  std::vector<Vector6d> boards;
  for (const Eigen::VectorXd& local : fit.local) boards.push_back(share * local.head<6>());
  state_ = moved(state_, x.head<6>(), boards);
  move_levels(fit, share);
  Eigen::Index at = 6;
  for (EffectInUse& use : in_use_) {
    use.values += x.segment(at, use.values.size());
    at += use.values.size();
  }
  bool whole = true;
  if (sees_print()) {
    whole = move_blur(x.segment<3>(at));
    at += 3;
  }
  for (SensorError& error : sensor_) {
    error.use.values += x.segment(at, error.use.values.size());
    at += error.use.values.size();
  }
  return whole;
}

void EffectSearch::move_levels(const ModelFit& fit, double share) {
  for (std::size_t s = 0; s < state_.levels.size(); ++s) {
    const Eigen::VectorXd step = share * fit.local[s].segment<kLevelParameters>(LocalLayout::kPose);
    BoardLevels& levels = state_.levels[s];
    levels.white += step(0);
    levels.black += step(1);
    levels.slope += step.tail<2>();
  }
}

// As far as the blur stays one: a covariance has no negative axis. Whether it went all the way.
bool EffectSearch::move_blur(const Eigen::Vector3d& step) {
  Eigen::Matrix2d change;
  change << step(0), step(1), step(1), step(2);
  Eigen::Matrix2d& blur = state_.beam.blur_rad2;
  for (double share = 1.0; share > 1e-3; share *= 0.5) {
    const Eigen::Matrix2d next = blur + share * change;
    // Widths change by half at most in one step: the print is linearised about them.
    if (next.determinant() > 0.1 * blur.determinant() && next(0, 0) > 0.25 * blur(0, 0)) {
      blur = next;
      return share == 1.0;
    }
  }
  return false;
}

// Structure that the calibration did not find may come to light once an effect is explained. The
// clearest kind enters; the others are asked again with it in.
bool EffectSearch::admit_structure() {
  constexpr double kChance = 0.01;  // As in the joint solve.
  bool any = false;
  while (!context_.stopped()) {
    const auto scores = group_scores(linear_, reference_.fit, context_.thread_count());
    std::size_t best = kVarianceGroups;
    double largest = 1.0;
    for (std::size_t k = 0; k < kVarianceGroups; ++k) {
      const GroupScore& score = scores[k];
      if (score.effective < 1.0 || !(score.determined > 0.0)) continue;
      const double ratio = score.squares / (variances_.group[k] * score.determined);
      const double gate = chi_square_gate(static_cast<int>(std::lround(score.effective)), kChance) /
                          score.effective;
      if (ratio / gate > largest) {
        largest = ratio / gate;
        best = k;
      }
    }
    if (best == kVarianceGroups) return any;
    any = true;
    // From where half of it would be told.
    variances_.group[best] *= scores[best].effective / scores[best].determined;
    reference_ = make_reference(linear_, own_subset(linear_.columns), variances_, how());
    variances_ = reference_.fit.variances;
  }
  return any;
}

// Weights and classes of rows follow the model, until both stand still.
void EffectSearch::remake() {
  if (!base_->again || (in_use_.empty() && table_ == base_)) return;
  // Each round leaves a few hundredths of what was wrong (up to a sixth was seen): more than two
  // are rarely needed.
  constexpr int kRounds = 5;
  constexpr double kLeft = 0.2;
  for (int round = 0; round < kRounds; ++round) {
    const Rigid3 before = state_.camera_from_lidar;
    // The table of the last round goes before the next one comes: each takes hundreds of bytes for
    // a return.
    memory_.reset();
    table_ = base_;
    remade_.reset();
    auto next = std::make_shared<MeasurementTable>(base_->again(state_, in_use_, context_));
    if (context_.stopped()) return;
    next->again = base_->again;
    remade_ = std::move(next);
    table_ = remade_.get();
    state_.beam.jitter_rad2 = table_->placed_by.beam.jitter_rad2;
    memory_.emplace(table());
    refit();
    if (admit_structure()) refit();
    if (context_.stopped()) return;
    // A twentieth of a standard deviation: what is left is far below what is known.
    constexpr double kStands = 0.05;
    const Eigen::VectorXd sigma = reference_.fit.covariance.diagonal().head<6>().cwiseSqrt();
    const Vector6d moved = se3_log(state_.camera_from_lidar * before.inverse());
    if ((kLeft * moved.array().abs() < kStands * sigma.array()).all()) return;
  }
}

std::vector<double> EffectSearch::shapes_worth_trying(
    const Effect& effect, std::optional<ChannelResiduals>& of_ranges) const {
  std::vector<double> shapes = effect.shapes(table());
  if (shapes.size() <= kFewShapes) return shapes;
  // Least squares of the range residuals on the effect alone, row by row: a periodogram.
  if (!of_ranges) of_ranges = residuals_of(table(), state_, model(), Channel::kRange, context_);
  const ChannelResiduals& residuals = *of_ranges;
  const auto p = effect.parameters(table()).size();
  const std::size_t stride = std::max<std::size_t>(1, residuals.values.size() / 20000);
  std::vector<double> power(shapes.size());
  parallel_for(shapes.size(), context_.thread_count(), [&](std::size_t k) {
    if (context_.stopped()) return;
    const auto n = static_cast<Eigen::Index>(p);
    Eigen::MatrixXd normal = 1e-9 * Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(n);
    std::vector<Eigen::Vector3d> moves(p);
    Eigen::VectorXd row(n);
    for (std::size_t i = 0; i < residuals.values.size(); i += stride) {
      const BeamPoint& beam = table().range[residuals.row[i]].beam;
      const double weight = 1.0 / residuals.sigma[i];
      const double residual = weight * residuals.values[i];
      effect.lidar(beam, table(), shapes[k], moves);
      // A matrix product is set up for longer than these few numbers take.
      for (Eigen::Index j = 0; j < n; ++j) {
        row(j) = weight * beam.direction.dot(moves[static_cast<std::size_t>(j)]);
        gradient(j) += residual * row(j);
        for (Eigen::Index l = 0; l <= j; ++l) normal(j, l) += row(j) * row(l);
      }
    }
    power[k] = gradient.dot(normal.ldlt().solve(gradient));
  });
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const bool peak = (k == 0 || power[k] >= power[k - 1]) &&
                      (k + 1 == shapes.size() || power[k] >= power[k + 1]);
    if (peak) order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return power[a] > power[b]; });
  std::vector<double> out;
  for (const std::size_t k : order) {
    if (out.size() < kSievedShapes) out.push_back(shapes[k]);
  }
  return out;
}

void EffectSearch::append_candidates(EffectColumnsList& columns) const {
  std::optional<ChannelResiduals> residuals;
  for (const EffectPtr& effect : effect_catalogue()) {
    const std::string& id = effect->info().id;
    const bool used = std::any_of(in_use_.begin(), in_use_.end(), [&](const EffectInUse& use) {
      return use.effect->info().id == id;
    });
    if (used || !why_not_testable(*effect, table()).empty()) continue;
    for (const double shape : shapes_worth_trying(*effect, residuals))
      columns.add(effect, shape, table());
  }
}

void EffectSearch::rank() {
  if (ranked_) return;
  EffectColumnsList columns = own_columns();
  const ColumnSubset subset = own_subset(columns);
  append_candidates(columns);
  linear_ = linearized(model(), columns);
  at_ = At::kLinear;
  candidates_.clear();
  if (context_.stopped()) return;
  reference_ = make_reference(linear_, subset, variances_, how());
  variances_ = reference_.fit.variances;
  const std::size_t first = own_count();
  candidates_.resize(columns.list().size() - first);
  const auto evaluate = [&](std::size_t k, std::size_t columns_at,
                            const MixedModelOptions& options) {
    if (context_.stopped()) return;
    candidates_[k] =
        evaluate_candidate(linear_, reference_, columns_at, options_->tolerance, options);
  };
  parallel_for(candidates_.size(), context_.thread_count(),
               [&](std::size_t k) { evaluate(k, first + k, {.rounds = 3}); });
  if (context_.stopped()) return;
  sort_best_first(candidates_);
  parallel_for(std::min(kFinalists, candidates_.size()), context_.thread_count(),
               [&](std::size_t k) { evaluate(k, candidates_[k].columns, {}); });
  sort_best_first(candidates_);
  for (Candidate& c : candidates_) {
    if (refused_.contains(linear_.columns.list()[c.columns].effect->info().id))
      c.contradiction = Contradiction::kScenes;
  }
  refit_promising();
  ask_both_prints();
  ask_structure();
  ranked_ = !context_.stopped();
}

// A strong effect has moved poses so far that the linearisation about them misjudges single scenes.
void EffectSearch::refit_promising() {
  const std::size_t tried = candidates_.size();
  for (std::size_t k = 0; k < std::min(kRefitted, tried) && !context_.stopped(); ++k) {
    Candidate& c = candidates_[k];
    if (is_accepted(c, tried, table().scenes.size(), *options_)) return;
    if (c.p_value * static_cast<double>(tried) > options_->false_alarm) continue;
    const EffectColumns& columns = linear_.columns.list()[c.columns];
    const Reference& without_it = reference_;
    EffectSearch trial(*this);
    trial.add(columns.effect, columns.shape);
    if (context_.stopped()) return;
    std::array<double, kChannels> with{};
    std::array<double, kChannels> without{};
    for (std::size_t s = 0; s < table().scenes.size(); ++s) {
      c.scene_density[s] = trial.reference_.density[s];
      c.scene_gain[s] = c.scene_density[s] - without_it.density[s];
      for (std::size_t channel = 0; channel < kChannels; ++channel) {
        with[channel] += trial.reference_.heldout[s][channel];
        without[channel] += without_it.heldout[s][channel];
      }
    }
    c.set_heldout(with, without, row_counts(linear_));
  }
}

// Where a simpler one predicts as well, the simpler: as many parameters as it has less might gain
// what it falls behind by chance (likelihood ratio, 5 %).
std::optional<std::size_t> EffectSearch::best() const {
  constexpr double kByChance = 0.05;
  const auto unknowns = [&](const Candidate& c) {
    const EffectColumns& columns = linear_.columns.list()[c.columns];
    return columns.count() + (columns.effect->shape_name().empty() ? 0 : 1);
  };
  std::optional<std::size_t> chosen;
  double most = 0.0;
  int first = 0;
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    const Candidate& c = candidates_[k];
    if (!is_accepted(c, candidates_.size(), table().scenes.size(), *options_)) continue;
    if (!chosen) {
      chosen = k;
      most = c.total_density();
      first = unknowns(c);
      continue;
    }
    // What shows in another channel may be there as well.
    const Candidate& now = candidates_[*chosen];
    if (c.main_channel() != now.main_channel() || unknowns(c) >= unknowns(now)) continue;
    const int fewer = first - unknowns(c);
    if (2.0 * (most - c.total_density()) < chi_square_gate(fewer, kByChance)) chosen = k;
  }
  return chosen;
}

EffectSearch EffectSearch::with_faint() const {
  EffectSearch out(*this);
  std::set<Channel> done;
  for (const Candidate& c : candidates_) {
    if (c.contradiction != Contradiction::kNone || !is_sure(c, candidates_.size(), *options_))
      continue;
    if (!done.insert(c.main_channel()).second) continue;
    const EffectColumns& columns = linear_.columns.list()[c.columns];
    out.add(columns.effect, columns.shape);
  }
  return out;
}

std::vector<ModelFit> EffectSearch::fits_with(const std::vector<LeftOutGroup>& groups) const {
  EffectColumnsList columns = own_columns();
  std::vector<ColumnSubset> subsets(1 + groups.size(), own_subset(columns));
  const auto append = [&](const LeftOut& other, ColumnSubset& subset) {
    append_columns(columns.list().back(), nullptr, subset);
    const auto count = static_cast<std::size_t>(other.sigma.size());
    for (std::size_t k = 0; k < count; ++k) {
      double& sigma = subset.prior_sigma[subset.prior_sigma.size() - count + k];
      // What cannot be there keeps a trace of what is believable.
      sigma = std::max(other.sigma(static_cast<Eigen::Index>(k)), 1e-6 * sigma);
    }
  };
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const LeftOut& other : groups[g]) {
      const std::string& id = other.effect->info().id;
      const bool used = std::any_of(in_use_.begin(), in_use_.end(), [&](const EffectInUse& use) {
        return use.effect->info().id == id;
      });
      if (used || !why_not_testable(*other.effect, table()).empty()) continue;
      columns.add(other.effect, 0.0, table());
      append(other, subsets.front());
      append(other, subsets[1 + g]);
    }
  }
  const Linearization linear = linearized(fitted(), columns);
  if (context_.stopped()) return {};
  std::vector<ModelFit> out;
  for (const ColumnSubset& subset : subsets) out.push_back(fit_as_it_stands(linear, subset));
  return out;
}

std::optional<ExtrinsicMove> EffectSearch::move_without(const EffectPtr& effect) const {
  const double shape = preferred_shape(effect);
  if (context_.stopped()) return std::nullopt;
  EffectColumnsList columns = own_columns();
  const ColumnSubset subset = own_subset(columns);
  columns.add(effect, shape, table());
  const Linearization linear = linearized(model(), columns);
  if (context_.stopped()) return std::nullopt;
  const Reference reference = make_reference(linear, subset, variances_, how(0));
  const Candidate c =
      evaluate_candidate(linear, reference, own_count(), options_->tolerance, how());
  const auto p = static_cast<Eigen::Index>(columns.list().back().count());
  const ExtrinsicMove move = move_if_omitted(c.fit, c.fit.solution.tail(p));
  if (!std::isfinite(move.translation_m) || !std::isfinite(move.rotation_rad)) return std::nullopt;
  return move;
}

std::optional<std::size_t> EffectSearch::superfluous() {
  // The model with all effects in use against those with one less.
  const Linearization linear = linear_here();
  if (context_.stopped()) return std::nullopt;
  const ColumnSubset all = own_subset(linear.columns);
  const Reference with = make_reference(linear, all, variances_, how(0));
  Eigen::Index next = 6;
  for (std::size_t k = 0; k < in_use_.size(); ++k) {
    const Eigen::VectorXd& values = in_use_[k].values;
    const Eigen::Index first = std::exchange(next, next + values.size());
    const Eigen::MatrixXd covariance =
        with.fit.covariance.block(first, first, values.size(), values.size());
    const double squares = values.dot(covariance.completeOrthogonalDecomposition().solve(values));
    const double tried = static_cast<double>(std::max<std::size_t>(candidates_.size(), 1));
    if (f_test(squares, values.size(), table().scenes.size()) * tried > options_->false_alarm)
      return k;
    // Without the effect its rows still hold the values in use: the candidate's increment undoes
    // them, so that the test of "increment equals minus the value" is that of the removal.
    ColumnSubset frozen = all;
    hold_at_zero(linear.columns.list()[k], values, frozen);
    const Reference without = make_reference(linear, frozen, variances_, how());
    std::vector<double> gain;
    for (std::size_t s = 0; s < with.density.size(); ++s)
      gain.push_back(with.density[s] - without.density[s]);
    if (!is_gain(gain)) return k;
  }
  return std::nullopt;
}

}  // namespace lvcalib
