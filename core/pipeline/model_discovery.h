// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/calibration.h"
#include "selection/discovery.h"
#include "selection/proposals.h"

namespace lvcalib {

/// What discovery starts from, out of a finished calibration: the scenes in use. Points into
/// `result`, which must outlive it.
DiscoveryInput discovery_input(const CalibrationResult& result);

/// How effects are searched in a calibration: its options for that, and its tolerance.
DiscoveryOptions discovery_options(const CalibrationOptions& options);

/// Looks for effects that the calibration's model misses.
/// Errors: as discover_effects.
Result<Discovery> discover(const CalibrationResult& result, const DiscoveryOptions& options,
                           const RunContext& context);

/// The calibration with the effects found in its model: extrinsic, covariance, board poses,
/// residuals.
CalibrationResult with_model(CalibrationResult result, const Discovery& discovery);

/// A result whose model lacks what scenes held out speak for is doubtful, and says so.
void judge_missing(CalibrationResult& result, const ModelRanking& ranking);

}  // namespace lvcalib
