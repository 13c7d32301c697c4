// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "discovery/effect_search.h"
#include "discovery/findings.h"

namespace lvcalib {

/// The greedy search: ranks all effects, adds the best that is accepted, tries its aliases in place
/// of effects added before, drops what has become superfluous, and starts again until nothing is
/// accepted, options.max_effects are reached or the context stops it.
///
/// `selections` names the effects in use in the search's order; the first `fixed` are the user's
/// and stay. It is kept in step, and on_added is called after every round that added something.
/// Ends with the candidates ranked about the final model.
void grow_model(EffectSearch& search, std::vector<Selection>& selections, std::size_t fixed,
                const DiscoveryOptions& options, const RunContext& context,
                const std::function<void()>& on_added);

}  // namespace lvcalib
