// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/calibration.h"
#include "selection/discovery.h"
#include "selection/model_session.h"
#include "selection/proposals.h"

namespace lvcalib {

/// What discovery starts from, out of a finished calibration: the scenes in use. Points into
/// `result`, which must outlive it.
DiscoveryInput discovery_input(const CalibrationResult& result);

/// How effects are searched in a calibration: its options for that, its tolerance, and what its
/// total uncertainty counts of faults left out.
DiscoveryOptions discovery_options(const CalibrationResult& result);

/// Looks for effects that the calibration's model misses.
/// Errors: as discover_effects.
Result<Discovery> discover(const CalibrationResult& result, const DiscoveryOptions& options,
                           const RunContext& context);

/// The calibration with the effects found in its model: extrinsic, covariance, board poses,
/// residuals.
CalibrationResult with_model(CalibrationResult result, const Discovery& discovery);

/// A model under which scenes agree that the solve had refused.
struct ExplainedScenes {
  Discovery discovery;
  CalibrationResult result;         ///< With them and the effects found in use.
  std::vector<std::string> scenes;  ///< Which they are.
};

/// The sentences "scene C contradicts the others only without range_walk: it is used, with that in
/// the model", one for each scene.
std::vector<Message> explanations(const ExplainedScenes& explained);

/// Scenes that the solve refused for contradicting the others may be those that show best what the
/// model lacks: a search with them in use. Nothing if no scene was refused so (or the file that is
/// wrong is known), or they contradict the others still with what was found.
/// Errors: kCancelled.
Result<std::optional<ExplainedScenes>> explain_refused_scenes(const CalibrationResult& result,
                                                              const DiscoveryOptions& options,
                                                              const RunContext& context);

/// The calibration at the last of a model's steps; `base` itself where that step has no effects.
/// `steps` begin at `base` and are all made.
std::shared_ptr<const CalibrationResult> result_at(
    const std::shared_ptr<const CalibrationResult>& base, const std::vector<ModelStepPtr>& steps);

}  // namespace lvcalib
