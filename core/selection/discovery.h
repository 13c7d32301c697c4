// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "diagnostics/channel_summary.h"
#include "diagnostics/structure_scan.h"
#include "model/model_scales.h"
#include "selection/discovery_options.h"
#include "selection/effect_finding.h"
#include "selection/model_session.h"
#include "selection/sensitivity_budget.h"

namespace lvcalib {

/// The model after a step of the search.
struct HistoryStep {
  std::string added;  ///< Empty at the start.
  std::vector<ChannelSummary> channels;
  Rigid3 camera_from_lidar;
};

struct Discovery {
  std::vector<ChannelSummary> channels;   ///< Of the base model.
  std::vector<StructureScore> structure;  ///< Of the base model, best first.
  std::vector<EffectFinding> effects;     ///< By rank.
  std::vector<std::string> selected;      ///< What the search added, in that order.
  std::vector<StructureScore> unknown;    ///< Left when the catalogue stopped.
  std::vector<HistoryStep> history;
  std::vector<Message> advice;
  std::vector<Message> warnings;   ///< Effects asked for that could not be used, and why.
  std::vector<BudgetItem> budget;  ///< Sensitivity budget, largest movement first.
  /// `covariance` plus the moments of the budget: what is not in the model counted as well.
  Matrix6d covariance_with_budget = Matrix6d::Zero();
  /// As ModelRanking has it; zero where nothing was ranked.
  Matrix6d covariance_total = Matrix6d::Zero();
  /// The final model.
  ModelState state;
  Matrix6d covariance = Matrix6d::Zero();  ///< Left perturbation, camera frame.
  std::vector<EffectInUse> model;
  ModelScales scales;  ///< What the model's numbers refer to.
  /// The linearised model about `state`, scene by scene: what some of the scenes would give.
  std::shared_ptr<const ModelFit> fit;

  /// Whether an effect is in the final model.
  [[nodiscard]] bool holds(const std::string& id) const;
  /// The effect that would be added next and is not, as no more were asked for; empty if there is
  /// none. Others that would do may only stand in for it.
  [[nodiscard]] std::string lacking() const;
};

/// Checks the texts of `with` without data, so that a slip of the pen is known before long work.
Status check_wanted(const std::vector<std::string>& with);

/// Searches which effects of the catalogue are missing in the model (linearised mixed model with
/// random effects for structure that nothing explains, candidates compared on held-out scenes,
/// full refit after each addition, drops and swaps). Deterministic.
/// Errors: kUntrusted with fewer than three scenes or without a joint solve over every return;
/// kUsage for an unknown effect in `with` or one of the user's own with an error in its text;
/// kCancelled. Effects in `with` that these data cannot bear (a missing field, values that are not
/// finite, the same as what is in the model) are left out with a warning and the verdict "not
/// testable".
Result<Discovery> discover_effects(const DiscoveryInput& input, const DiscoveryOptions& options,
                                   const RunContext& context);

/// The same on a table of measurements; its scenes must have one board pose each in `state`.
Result<Discovery> discover_effects(const MeasurementTable& table, const ModelState& state,
                                   const DiscoveryOptions& options, const RunContext& context);

}  // namespace lvcalib
