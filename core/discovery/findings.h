// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "discovery/effect_search.h"

namespace lvcalib {

/// Ids of accepted candidates that correlate with the one chosen, or that held-out scenes do not
/// tell from it.
std::vector<std::string> aliases_of(const EffectSearch& search, std::size_t chosen,
                                    const DiscoveryOptions& options);

/// Says of structure that is left what it does to the extrinsic: as the curve that would take it
/// out, left out. `explained` is the model that it is left by.
void judge_unknown(const EffectSearch& explained, const DiscoveryOptions& options,
                   std::vector<StructureScore>& unknown);

/// Verdicts on the whole catalogue from the finished search (rank() must have run on the final
/// model). Selected effects first, then the rest by their gain.
std::vector<EffectFinding> judge_effects(const EffectSearch& search,
                                         const std::vector<Selection>& selected,
                                         const DiscoveryOptions& options);

}  // namespace lvcalib
