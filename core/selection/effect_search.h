// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "diagnostics/structure_scan.h"
#include "selection/candidate.h"

namespace lvcalib {

/// Covariance of the beam's spot in the beam's frame, footprint and pointing jitter together.
struct MeasuredBlur {
  Eigen::Vector3d rad2 = Eigen::Vector3d::Zero();        ///< Horizontal, mixed, vertical.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of these, rad⁴.
};

/// State of the search: effects in use with their values, the poses, and the model about them.
class EffectSearch {
 public:
  EffectSearch(const MeasurementTable& table, ModelState state, const DiscoveryOptions& options,
               const RunContext& context);
  /// Takes up the search at a model with effects in use, whose values are fitted again.
  EffectSearch(const MeasurementTable& table, ModelState state, std::vector<EffectInUse> in_use,
               const DiscoveryOptions& options, const RunContext& context);

  /// Goes on from where it was laid aside: who is told of progress and may stop it from now on.
  void go_on(const RunContext& context) {
    context_ = context;
    if (!memory_) memory_.emplace(table());
  }
  /// Lets go of the print as each row saw it last, 44 bytes for each: it only saves time, and
  /// little where the state stays near that of the table.
  void forget_print() { memory_.reset(); }
  /// To be kept for later: nobody is told any more, and what only saves time is let go.
  void lay_aside() {
    context_ = {};
    forget_print();
    with_slopes_.reset();
  }
  /// Adds an effect without asking and refits.
  void add(const EffectPtr& effect, double shape);
  /// Takes effect number k out and refits.
  void remove(std::size_t k);
  /// One effect in the place of another.
  struct Swap {
    EffectPtr effect;
    double shape = 0.0;
    std::vector<double> gain;  ///< In held-out log-density, per scene.
    ModelFit step;             ///< The step in which the one goes as the other comes.
  };
  /// What it would gain to put each of some effects in the place of number k, to first order about
  /// the model as it is, at its shape number that gains most. Empty if stopped.
  [[nodiscard]] std::vector<Swap> swaps(std::size_t k, const std::vector<EffectPtr>& effects) const;
  /// Makes one of the swaps of effect number k and refits, from where its step leads.
  void replace(std::size_t k, const Swap& swap);
  /// Among an effect's shape numbers the one whose model predicts held-out scenes best.
  [[nodiscard]] double preferred_shape(const EffectPtr& effect) const;
  /// Moves effect k's shape number from the grid of the search to where the restricted likelihood
  /// is largest and refits: what a coarse shape leaves over looks like other effects.
  void refine_shape(std::size_t k);
  /// Moves the shape numbers in use from the grid of the search to where the restricted likelihood
  /// is largest (between their neighbours on the grid), refits, and estimates the covariance of all
  /// unknowns with the shape numbers among them.
  void refine_shapes();
  /// Covariance of extrinsic and effects in use: with uncertain shape numbers after
  /// refine_shapes(), with known ones before.
  [[nodiscard]] const Eigen::MatrixXd& joint_covariance() const {
    return joint_covariance_ ? *joint_covariance_ : reference_.fit.covariance;
  }
  /// Standard deviation of effect k's shape number after refine_shapes(); 0 if it has none.
  [[nodiscard]] double shape_sigma(std::size_t k) const {
    return k < shape_sigmas_.size() ? shape_sigmas_[k] : 0.0;
  }
  /// Gauss–Newton on extrinsic, poses and effects until the extrinsic stands still.
  void refit();
  /// Makes the table again for the model as it is (see MeasurementTable::again) and refits: to be
  /// called when effects have come or gone.
  void remake();
  /// The search at what is stated of its model (see fit_stated()): what it compares has motions of
  /// whole boards as random effects, and no errors of the sensor's ranges that are not explained:
  /// these are what it looks for. Nothing where neither is there: then it stands there.
  [[nodiscard]] std::optional<EffectSearch> as_stated() const;
  /// The table that remake() made; null if there was nothing to do.
  [[nodiscard]] std::shared_ptr<const MeasurementTable> remade() const { return remade_; }
  /// Linearises with all candidates that are testable and not in use, and evaluates each. Does
  /// nothing if that was done for the model as it is.
  void rank();
  /// From the next rank() on an effect is not accepted: scenes held out contradict it.
  void refuse(const std::string& id) {
    refused_.insert(id);
    ranked_ = false;
  }
  /// What was refused may be accepted again, beside what has come in since.
  void forget_refusals() {
    refused_.clear();
    ranked_ = false;
  }
  /// After rank(): index of the best accepted candidate, or of the simplest that predicts as well.
  [[nodiscard]] std::optional<std::size_t> best() const;
  /// After rank(): the model with effects that are sure but explain too little to be let in, of
  /// each channel the one that gains most. What it leaves is what no effect of the catalogue
  /// explains.
  [[nodiscard]] EffectSearch with_faint() const;
  /// An effect that is not in the model, drawn to zero by sizes (one standard deviation, SI).
  struct LeftOut {
    EffectPtr effect;
    Eigen::VectorXd sigma;
  };
  using LeftOutGroup = std::vector<LeftOut>;
  /// The model's fit as it stands with effects that it leaves out as further unknowns: with those
  /// of all groups, then with each group's alone. What is in the model is passed over. Empty if
  /// stopped.
  [[nodiscard]] std::vector<ModelFit> fits_with(const std::vector<LeftOutGroup>& groups) const;
  /// What leaving an effect out does to the extrinsic, at what the data say of it beside the model;
  /// nothing if they say nothing.
  [[nodiscard]] std::optional<ExtrinsicMove> move_without(const EffectPtr& effect) const;
  /// An effect in use that would not be let in any more, beside the others: chance reaches its size
  /// among as many candidates as were tried, or held-out scenes do not notice its removal (the mean
  /// loss over scenes is within its standard error).
  [[nodiscard]] std::optional<std::size_t> superfluous();

  /// Shape numbers of an effect; of very many the few that the range residuals speak for.
  [[nodiscard]] std::vector<double> shapes_worth_trying(const Effect& effect) const {
    std::optional<ChannelResiduals> residuals;
    return shapes_worth_trying(effect, residuals);
  }

  [[nodiscard]] const MeasurementTable& table() const { return *table_; }
  [[nodiscard]] const ModelState& state() const { return state_; }
  /// The beam's blur as the model measures it; nothing where no intensity tells it.
  [[nodiscard]] std::optional<MeasuredBlur> measured_blur() const;
  /// Effects found or asked for, in the order added.
  [[nodiscard]] const std::vector<EffectInUse>& in_use() const { return in_use_; }
  /// Those and the beam's blur: what the model predicts with. What is stated does not predict the
  /// sensor's errors: nothing explains them, and that must show.
  [[nodiscard]] std::vector<EffectInUse> model() const;
  [[nodiscard]] const Linearization& linear() const { return linear_; }
  [[nodiscard]] const Reference& reference() const { return reference_; }
  [[nodiscard]] const std::vector<Candidate>& candidates() const { return candidates_; }

 private:
  // Lets groups of random effects in that were absent and that the residuals show.
  bool admit_structure();
  // What became of a step that is `size` standard deviations long.
  enum class Descent {
    kNone,    // No part of it fits better.
    kLittle,  // It is taken and hardly fits better: the last.
    kOn,      // It is taken.
  };
  Descent descend(double size);
  // False if the blur could not follow.
  bool move(const ModelFit& fit, double share);
  void move_levels(const ModelFit& fit, double share);
  bool move_blur(const Eigen::Vector3d& step);
  void refit_from(Linearization start);
  // The linearisation about the state as it is.
  [[nodiscard]] Linearization linear_here() const;
  // Judges promising candidates again after a full refit, until one is accepted.
  void refit_promising();
  // Takes accepted candidates off the list that white and black print contradict.
  void ask_both_prints();
  void doubt_levels(const std::function<bool(const Candidate&)>& disagree);
  // And those that stand in for structure which no effect explains.
  void ask_structure();
  [[nodiscard]] bool stands_in(const Candidate& candidate, Channel channel,
                               const StructureScore& curve) const;
  // Whether one of these places predicts better than the candidate and keeps most of that with it.
  [[nodiscard]] bool leaves_a_place(const Candidate& candidate,
                                    std::vector<StructureScore> places) const;
  void contradict(const Candidate& candidate, Contradiction by);  // at all its shape numbers
  // The model and the sensor's errors: what the rows are fitted with.
  [[nodiscard]] std::vector<EffectInUse> fitted() const;
  [[nodiscard]] EffectColumnsList own_columns() const;
  // By these effects' columns about the state in use.
  [[nodiscard]] Linearization linearized(const std::vector<EffectInUse>& effects,
                                         const EffectColumnsList& columns,
                                         const ChannelMask& channels = kEveryChannel) const {
    return linearize(table(), state_, effects, columns, context_,
                     {channels, memory_ ? &*memory_ : nullptr});
  }
  // Columns that stand for effect number `of`, its value in use taken for zero.
  struct OtherColumns {
    std::size_t of, columns;
  };
  [[nodiscard]] ColumnSubset own_subset(const EffectColumnsList& columns,
                                        const std::optional<OtherColumns>& other = {}) const;
  // `residuals`: of the ranges, the same for every effect; the first that asks for them fills them
  // in.
  [[nodiscard]] std::vector<double> shapes_worth_trying(
      const Effect& effect, std::optional<ChannelResiduals>& residuals) const;
  void append_candidates(EffectColumnsList& columns) const;
  void settle();
  bool update_sensor_variances();
  bool move_shape(std::size_t k);
  // Restricted log-likelihood at shape numbers of effect k, all other values as they are, to first
  // order in what the effect moves. Only the channels on which it acts change with the shape: the
  // first call keeps the others in `elsewhere`, later ones with as many shapes take them from
  // there.
  [[nodiscard]] std::vector<double> shape_profile(std::size_t k, const std::vector<double>& shapes,
                                                  std::optional<Linearization>& elsewhere) const;
  void estimate_joint_covariance();
  // A fit on all threads.
  [[nodiscard]] MixedModelOptions how(int rounds = MixedModelOptions{}.rounds) const {
    return {.rounds = rounds, .threads = context_.thread_count()};
  }
  // Of own columns and others, with the variances of the search or as it is stated.
  [[nodiscard]] ModelFit fit_as_it_stands(const Linearization& linear,
                                          const ColumnSubset& subset) const;
  // Effects in use, the beam's blur, which only intensities tell, and the sensor's errors.
  [[nodiscard]] std::size_t own_count() const {
    return in_use_.size() + (sees_print() ? 1 : 0) + sensor_.size();
  }
  [[nodiscard]] bool sees_print() const { return table().has_intensity; }

  const MeasurementTable* base_;   // what was given
  const MeasurementTable* table_;  // that, or …
  std::shared_ptr<const MeasurementTable> remade_;
  mutable std::optional<PrintMemory> memory_;  ///< Of the table in use: a cache of predictions.
  ModelState state_;
  const DiscoveryOptions* options_;  ///< The caller's; a pointer, so that a search can be put back.
  RunContext context_;  ///< by value: copies are cheap and a caller's temporary may not outlive it
  std::vector<EffectInUse> in_use_;
  EffectInUse blur_;
  // In what is stated, errors of the sensor that nothing explains, each kind with its variance.
  struct SensorError {
    EffectInUse use;
    double variance = 0.0;
  };
  std::vector<SensorError> sensor_;
  ModelVariances variances_;
  std::optional<StatedVariances> stated_;  ///< Of what is stated, else not there.
  Linearization linear_;
  Reference reference_;
  // Where the state stands.
  enum class At {
    kLinear,  // At what `linear_` is about.
    kFit,     // At the reference's fit, the last step of a refit.
    kBeyond,  // Somewhere near.
  } at_ = At::kLinear;
  std::vector<Candidate> candidates_;
  bool ranked_ = false;  // `candidates_` are those of the model as it is.
  std::set<std::string> refused_;
  std::optional<Eigen::MatrixXd> joint_covariance_;
  std::vector<double> shape_sigmas_;
  // That of the joint covariance, until the state moves.
  std::optional<Linearization> with_slopes_;
};

}  // namespace lvcalib
