// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "selection/effect_finding.h"
#include "selection/effect_search.h"

namespace lvcalib {

/// The greedy search: ranks all effects, adds the best that is accepted, tries its aliases in place
/// of effects added before, drops what has become superfluous, and starts again until nothing is
/// accepted, options.max_effects are reached or the context stops it.
///
/// `selections` names the effects in use in the search's order; what the user wanted stays. It is
/// kept in step, and on_added is called after every round that added something. Whether it runs in
/// one go or is taken up again at any of those rounds makes no difference.
/// Ends with the candidates ranked about the final model.
void grow_model(EffectSearch& search, std::vector<Selection>& selections,
                const DiscoveryOptions& options, const RunContext& context,
                const std::function<void()>& on_added);

}  // namespace lvcalib
