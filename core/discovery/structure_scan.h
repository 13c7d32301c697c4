// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "discovery/covariates.h"
#include "discovery/discovery.h"

namespace lvcalib {

/// Share of held-out variance that a smooth curve of one covariate explains: cubic B-splines
/// (shrunken means for categories) fitted on all scenes but one and predicted on that one, whose
/// pose and levels are fitted again. `amplitude` is the curve's RMS. Not above zero if there is
/// none.
StructureScore structure_score(const Covariate& covariate, Channel channel,
                               const ChannelResiduals& residuals, int scenes);

/// Scores of every covariate of every channel, best first. Scenes held out one by one.
std::vector<StructureScore> scan_structure(const MeasurementTable& table, const ModelState& state,
                                           const std::vector<EffectInUse>& in_use,
                                           const RunContext& context);

}  // namespace lvcalib
