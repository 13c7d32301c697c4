// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "discovery/effect_search.h"

namespace lvcalib {

/// What became of the effects that were asked for.
struct WantedEffects {
  std::vector<std::string> added;      ///< Ids, in the order asked for.
  std::vector<EffectFinding> refused;  ///< The user's own that these data cannot bear.
  std::vector<std::string> warnings;   ///< Why, and what was asked for twice.
};

/// Adds the effects of options.with to the model. What the data cannot bear is left out, named in
/// the warnings, and the rest goes on. Errors: kUsage as check_wanted().
Result<WantedEffects> add_wanted_effects(EffectSearch& search, const DiscoveryOptions& options);

}  // namespace lvcalib
