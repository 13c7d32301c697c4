// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "design/scene_advice.h"
#include "diagnostics/structure_scan.h"
#include "selection/effect_finding.h"
#include "selection/effect_search.h"

namespace lvcalib {

/// The columns of one of a search's candidates.
const EffectColumns& columns_of(const EffectSearch& search, const Candidate& candidate);

/// Ids of accepted candidates that correlate with the one chosen, or that held-out scenes do not
/// tell from it.
std::vector<std::string> aliases_of(const EffectSearch& search, std::size_t chosen,
                                    const DiscoveryOptions& options);

/// Whether a structure's score, one of so many tried, is large enough to be mentioned.
bool is_notable(const StructureScore& score, std::size_t tried, const DiscoveryOptions& options);

/// Those of all scores tried that are notable, best first.
std::vector<StructureScore> notable_of(std::vector<StructureScore> scores,
                                       const DiscoveryOptions& options);
std::vector<StructureScore> notable_of(const StructureScan& scan, const DiscoveryOptions& options);

/// Says of structure that is left what it does to the extrinsic: as the curve that would take it
/// out, left out. `explained` is the model that it is left by.
void judge_unknown(const EffectSearch& explained, const DiscoveryOptions& options,
                   std::vector<StructureScore>& unknown);

/// The scenes that a search looks at and its model. Refers to the search, on which rank() must have
/// run.
ScenesTaken scenes_taken(const EffectSearch& search);

/// What one more scene should tell: effects of the model from their aliases, and whether those are
/// there that could move the extrinsic unseen; the most important few.
OpenQuestions open_questions(const EffectSearch& search,
                             const std::vector<EffectFinding>& findings);

/// Verdicts on the whole catalogue from the finished search (rank() must have run on the final
/// model). Selected effects first, with the values of `stated` (see EffectSearch::as_stated();
/// null: those of the search), then the rest by their gain.
std::vector<EffectFinding> judge_effects(const EffectSearch& search,
                                         const std::vector<Selection>& selected,
                                         const DiscoveryOptions& options,
                                         const EffectSearch* stated = nullptr);

}  // namespace lvcalib
