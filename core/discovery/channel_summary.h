// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "discovery/candidate.h"
#include "model/residuals.h"

namespace lvcalib {

/// RMS, noise floor, unexplained part and held-out RMS of every channel that has rows.
std::vector<ChannelSummary> summarize_channels(const EveryResidual& residuals,
                                               const std::vector<EffectInUse>& in_use,
                                               const Reference& reference);

}  // namespace lvcalib
