// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "selection/discovery.h"

namespace lvcalib {

/// What adding an effect to a model would do, as held-out scenes judge it.
struct EffectProposal {
  EffectFinding finding;
  bool suggested = false;  ///< Held-out scenes and the test speak for it.
  std::string alias_of;    ///< Suggested effect that it cannot be told from; empty: none.
  /// Relative fall of each channel's held-out squares; negative if they grow.
  std::array<double, kChannels> heldout_fall{};
  Channel channel = Channel::kRange;  ///< Where it helps most.
  double gained_mm = 0.0;             ///< By how much the extrinsic moves when it is added, …
  double gained_mrad = 0.0;           ///< … and turns.
};

/// What is in a model, and what is missing.
struct ModelRanking {
  /// Effects in use that are switched on, in the model's order: what they are known by, and what
  /// leaving them out would do.
  std::vector<EffectFinding> in_use;
  /// Suggested ones first, each followed by its aliases; then the rest by gain. Effects in use are
  /// not among them.
  std::vector<EffectProposal> proposals;
  /// Structure that is left although nothing is suggested: no known effect explains it.
  std::vector<StructureScore> unknown;
  std::vector<Message> advice;  ///< Scenes worth taking, and what else would tell.
  /// What effects that are not in the model could still do to the extrinsic, largest first.
  std::vector<BudgetItem> budget;
  /// Of the extrinsic, with what faults left out of the model could still do (see
  /// total_covariance()) and what the best proposal would move it by.
  Matrix6d covariance_total = Matrix6d::Zero();

  [[nodiscard]] bool nothing_missing() const;
  /// Whether structure is left that would move the extrinsic by more than the tolerance.
  [[nodiscard]] bool unknown_matters() const;
  /// Whether what is missing speaks against a good result: an effect is suggested, or that.
  [[nodiscard]] bool speaks_against_good() const;
};

/// Judges the effects in use and tries every other. Structure that is left gets closed forms; the
/// advice names board poses if the step's options ask for them. Deterministic. Errors: kCancelled.
Result<ModelRanking> rank_effects(const ModelStep& step, const RunContext& context);

/// Steps (base first, the model shown last) and, if there is one, the last step's ranking as the
/// outcome of a search: for files and reports. What `lvcalib discover` writes is this, too.
Discovery as_discovery(const std::vector<ModelStepPtr>& steps, const ModelRanking* ranking);

}  // namespace lvcalib
