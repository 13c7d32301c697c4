// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "diagnostics/channel_summary.h"
#include "diagnostics/structure_scan.h"
#include "model/fitted_model.h"
#include "model/mixed_model.h"
#include "model/user_effect.h"
#include "selection/discovery_options.h"
#include "selection/effect_finding.h"
#include "solve/forward_problem.h"
#include "solve/print_table.h"

namespace lvcalib {

class EffectSearch;

/// What discovery starts from: the scenes in use and the state of the plain calibration. The print
/// is null where the joint solve over every return failed.
struct DiscoveryInput : TableInput {
  ModelState state;
};

/// The measurements of a calibration, with every covariate. The input needs its print.
MeasurementTable table_of(const DiscoveryInput& input, const TableOptions& options);

/// Which steps' residuals are searched for structure; that of others is left empty.
enum class StructureOf {
  kEveryStep,  ///< For whoever looks at each.
  kFirstStep,  ///< Of the base model alone.
};

/// What the steps of one session share: the measurements and how effects are judged.
struct ModelBasis {
  MeasurementTable table;
  DiscoveryOptions options;
  StructureOf structure = StructureOf::kEveryStep;
};

/// What was done to a model to make a step.
enum class ModelChange { kStart, kAdd, kRemove, kSwitchOff, kSwitchOn, kHold, kRelease };

/// An effect of a model as its user holds it.
struct ModelTerm {
  std::string spec;  ///< What make_effect() takes: an id, or a formula or curve.
  EffectInUse use;
  std::vector<EffectParameter> parameters;
  Eigen::VectorXd sigma;  ///< Standard deviations (SI); zero where the values are held.
  Selection selection;    ///< How it came into the model.
  bool on = true;         ///< Off: kept with its values, no part of the model.

  [[nodiscard]] std::vector<ParameterEstimate> estimates() const;
};

/// A fitted model and how well it predicts. Never changed once made: going back is looking at an
/// older step, and steps may be read from any thread.
struct ModelStep {
  std::shared_ptr<const ModelBasis> basis;
  ModelChange change = ModelChange::kStart;
  std::string changed;  ///< Spec of the effect that `change` is about.
  /// The change could not be made, as of an effect that is not known: the model is as it was.
  bool without_change = false;
  ModelState state;
  Matrix6d covariance = Matrix6d::Zero();  ///< Of the extrinsic; left, camera frame.
  std::shared_ptr<const ModelFit> fit;     ///< Linearised about `state`, scene by scene.
  std::vector<ModelTerm> terms;
  std::vector<EffectInUse> nuisance;  ///< Nature's share that is no effect to find.
  std::vector<ChannelSummary> channels;
  std::vector<StructureScore> structure;  ///< Every covariate's, best first (see StructureOf).
  std::vector<StructureScore> places;     ///< Of surfaces, best first (see StructureScan).
  /// The search that stands at this model: where the next step takes it up.
  std::shared_ptr<const EffectSearch> search;
  /// What is stated of the model (see EffectSearch::as_stated()); null: the search stands there.
  std::shared_ptr<const EffectSearch> stated;
  /// The measurements made again for this model (see MeasurementTable::again); null where that
  /// changes nothing.
  std::shared_ptr<const MeasurementTable> remade;

  [[nodiscard]] const MeasurementTable& table() const { return remade ? *remade : basis->table; }
  /// The effects that are switched on.
  [[nodiscard]] std::vector<EffectInUse> in_use() const;
  /// Those and the nuisance: what the measurements are compared with.
  [[nodiscard]] std::vector<EffectInUse> predicted_with() const;
  /// The model to those who look at its predictions, as long as the step is there.
  [[nodiscard]] FittedModel fitted() const { return {table(), state, predicted_with()}; }
  /// Place of an effect among the terms.
  [[nodiscard]] std::optional<std::size_t> find(const std::string& spec) const;
};
using ModelStepPtr = std::shared_ptr<const ModelStep>;

/// The effect that a specification stands for: an id of the catalogue, or a user's own formula or
/// curve (see make_user_effect()). Error (kUsage) if there is none, with the nearest known one.
Result<EffectPtr> make_effect(const std::string& spec, const MeasurementTable& table,
                              const UserEffectOptions& options = {});

/// Collects the measurements and fits the base model. Errors as discover_effects().
Result<ModelStepPtr> start_model(const DiscoveryInput& input, const DiscoveryOptions& options,
                                 const RunContext& context,
                                 StructureOf structure = StructureOf::kEveryStep);
/// The same from measurements collected already.
Result<ModelStepPtr> start_model(MeasurementTable table, const ModelState& state,
                                 const DiscoveryOptions& options, const RunContext& context,
                                 StructureOf structure = StructureOf::kEveryStep);

/// The model with one more effect, fitted. The shape number starts at `shape`, or at the one that
/// held-out scenes prefer, and is refined. Switches it on if it is there and off. Errors: kUsage
/// for unknown effects or one that is in use; kInput if the measurements lack what it needs, or if
/// it acts just as what is in the model does, which makes the solve singular; kCancelled.
Result<ModelStepPtr> add_effect(const ModelStepPtr& from, const std::string& spec,
                                std::optional<double> shape, const RunContext& context);
/// The model without term k, fitted. Errors: kCancelled.
Result<ModelStepPtr> remove_effect(const ModelStepPtr& from, std::size_t k,
                                   const RunContext& context);
/// The model with term k switched on or off, fitted. Errors: kCancelled.
Result<ModelStepPtr> switch_effect(const ModelStepPtr& from, std::size_t k, bool on,
                                   const RunContext& context);
/// The model with term k held at these values (SI), or with its values fitted again if there are
/// none. Errors: kUsage for a wrong number of values or one that is not finite; kCancelled.
Result<ModelStepPtr> hold_effect(const ModelStepPtr& from, std::size_t k,
                                 const std::optional<Eigen::VectorXd>& values,
                                 const RunContext& context);

/// A decision of a saved model: enough to make its step again.
struct ModelDecision {
  ModelChange change = ModelChange::kAdd;
  std::string spec;
  std::vector<double> values;  ///< SI, for kHold.
  bool operator==(const ModelDecision&) const = default;
};
/// Makes a decision's step. Errors as the functions above; kUsage if the effect is not there.
Result<ModelStepPtr> apply_decision(const ModelStepPtr& from, const ModelDecision& decision,
                                    const RunContext& context);

/// Decisions that turn one step of a search into the next: what it dropped or swapped out, then
/// what it added or took back in.
std::vector<ModelDecision> decisions_between(const ModelStep& before, const ModelStep& after);

/// The search's own loop from here: adds the best accepted effect and drops what it makes
/// superfluous (nothing that the user added), until no effect is accepted. `on_step` sees every
/// step; taken up at any of them, it ends at the same model. Errors: kCancelled.
Result<ModelStepPtr> find_all(const ModelStepPtr& from,
                              const std::function<void(const ModelStepPtr&)>& on_step,
                              const RunContext& context);

}  // namespace lvcalib
