// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "diagnostics/structure_scan.h"

namespace lvcalib {

/// A closed form suggested for structure in one covariate.
struct ClosedForm {
  std::string formula;  ///< A user's effect, "formula:range:a*sin(12.5*azimuth)"; empty if none.
  double score = 0.0;   ///< Share of held-out variance that it explains.
};

/// Looks for the sum of at most two of 1, x, x², ln x, 1/x, √x, exp, sin with cos (of several
/// wave lengths), a step (at several places), tan and cos 2x that predicts scenes held out best;
/// one term if that is as good within one standard error over scenes. Functions that are not finite
/// on all values are left out. Labels have no closed form.
ClosedForm closed_form_of(const Covariate& covariate, Channel channel,
                          const ChannelResiduals& residuals, int scenes);

/// Fills `formula` and `formula_score` of the best scores, at most `most` of them.
void suggest_closed_forms(const MeasurementTable& table, const ModelState& state,
                          const std::vector<EffectInUse>& in_use, std::size_t most,
                          const RunContext& context, std::vector<StructureScore>& scores);

}  // namespace lvcalib
