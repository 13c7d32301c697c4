// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/message.h"
#include "diagnostics/structure_scan.h"
#include "model/effect.h"
#include "selection/effect_finding.h"

namespace lvcalib {

/// The curve that takes structure out, as one asks for it with `--with`.
std::string curve_spec(const StructureScore& structure);

/// "a = 1.20 ± 0.10 mm, b = …": what was found of an effect's parameters, the first four.
Message values_text(const EffectFinding& finding);

/// " These scenes cannot tell it from a or b; to tell: …": what a found effect may be as well.
Message not_told_apart(const EffectFinding& finding, const EffectInfo& info);

/// The strongest structure of each channel: others of a channel mostly see the same.
std::vector<StructureScore> strongest_of_each_channel(const std::vector<StructureScore>& unknown);

/// That no effect explains it, where it is and how large, in a sentence.
Message unknown_text(const StructureScore& structure);

/// What to do about the strongest structure of each channel that no effect explains, on a command
/// line: the curve, and the closed form if there is one, to ask for with `--with`.
std::vector<Message> advise_unknown(const std::vector<StructureScore>& unknown);

/// Scenes worth taking, in words.
std::vector<Message> advise(const std::vector<EffectFinding>& findings);

}  // namespace lvcalib
