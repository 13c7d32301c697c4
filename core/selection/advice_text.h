// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "diagnostics/structure_scan.h"
#include "selection/effect_finding.h"

namespace lvcalib {

/// The curve that takes structure out, as one asks for it with `--with`.
std::string curve_spec(const StructureScore& structure);

/// What to do about structure that no effect explains: the curve, and the closed form if there is
/// one, to ask for with `--with`; the strongest few, one covariate per channel.
std::vector<std::string> advise_unknown(const std::vector<StructureScore>& unknown);

/// Scenes worth taking, in words.
std::vector<std::string> advise(const std::vector<EffectFinding>& findings);

}  // namespace lvcalib
