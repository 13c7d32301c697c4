// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What discovery said of a rig with hidden effects, as tests ask for it.

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "selection/discovery.h"
#include "support/effect_rigs.h"

namespace lvcalib::test {

inline const EffectFinding& finding(const Discovery& discovery, const std::string& id) {
  const auto at = std::find_if(discovery.effects.begin(), discovery.effects.end(),
                               [&](const EffectFinding& f) { return f.id == id; });
  EXPECT_NE(at, discovery.effects.end()) << id;
  return *at;
}

/// The selected effects and those that the tool says they cannot be told from.
inline std::vector<std::string> with_aliases(const Discovery& discovery) {
  std::vector<std::string> out = discovery.selected;
  for (const std::string& id : discovery.selected) {
    const auto& aliases = finding(discovery, id).aliases;
    out.insert(out.end(), aliases.begin(), aliases.end());
  }
  return out;
}

/// Without what every simulated scan has.
inline std::vector<std::string> beyond_the_footprint(std::vector<std::string> selected) {
  std::erase_if(selected, [](const std::string& id) {
    const auto& always = always_simulated();
    return std::find(always.begin(), always.end(), id) != always.end();
  });
  return selected;
}

inline const ChannelSummary& summary_of(const std::vector<ChannelSummary>& all, Channel which) {
  const auto at = std::find_if(all.begin(), all.end(),
                               [&](const ChannelSummary& c) { return c.channel == which; });
  EXPECT_NE(at, all.end());
  return *at;
}

}  // namespace lvcalib::test
