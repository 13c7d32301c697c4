// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "model/linear_model.h"
#include "model/table_builder.h"

namespace lvcalib {

/// The table with its edges measured again, after what single lines, the scan or time do to the
/// points about the circles has been taken out of these.
///
/// An edge is where the level of many points crosses the middle. Effects that move the points of
/// one edge apart (offsets of lines, a lag along the scan) blur it, and beyond a fraction of the
/// blur it no longer moves by the mean of what moves its points. So each point about a circle is
/// moved back by what the effects in use, at their values, do along the edge's normal; circles are
/// refined again; and each edge found is given the mean movement of its points back: residuals stay
/// those of a scan as it was, and the effects stay free.
///
/// Nothing if such effects move the points about circles by less than `least_m` (RMS), if there is
/// nothing to measure with, where a board cannot be refined, or when stopped.
std::optional<MeasurementTable> remeasure_edges(const MeasurementTable& table,
                                                const ModelState& state,
                                                const std::vector<EffectInUse>& in_use,
                                                const RunContext& context, double least_m = 5e-5);

/// The table made again for a model: with its points placed on the board by `state`, if that has
/// moved them by a quarter of a footprint, and with its edges measured again for the effects in
/// use. Null if neither changes anything, or when stopped.
std::shared_ptr<const MeasurementTable> remeasured(const MeasurementTable& table,
                                                   const ModelState& state,
                                                   const std::vector<EffectInUse>& in_use,
                                                   const RunContext& context);

/// Whether a table with a source would be made otherwise for this model: points have moved by a
/// quarter of a footprint since it was made, or effects in use move the points of an edge apart,
/// and their values with them.
bool is_outdated(const MeasurementTable& table, const ModelState& state,
                 const std::vector<EffectInUse>& in_use);

}  // namespace lvcalib
