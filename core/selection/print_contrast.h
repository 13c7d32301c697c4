// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "selection/candidate.h"

namespace lvcalib {

/// What a search is about to add to: the measurements and the model in use.
struct ModelInUse {
  const MeasurementTable& table;
  const ModelState& state;
  const std::vector<EffectInUse>& effects;
  const EffectColumnsList& columns;  ///< Of `effects`.
  const ColumnSubset& subset;        ///< Of `columns`.
  const ModelVariances& variances;
};

/// Whether white and black print, each by themselves, contradict each other about a candidate in a
/// channel (ranges or intensities): beside it and a constant difference between the prints, its
/// print contrast is there and so large that one print shows nothing, less than a third of what the
/// other does, or the opposite. What depends on the print is then something else.
bool prints_disagree(const ModelInUse& model, const EffectColumns& candidate, Channel channel,
                     const DiscoveryOptions& options, const RunContext& context);

}  // namespace lvcalib
