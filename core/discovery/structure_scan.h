// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "discovery/covariates.h"
#include "discovery/discovery.h"

namespace lvcalib {

/// Share of held-out variance that a smooth curve of one covariate explains: cubic B-splines
/// (shrunken means for categories) fitted on all scenes but one and predicted on that one, whose
/// pose and levels are fitted again. `amplitude` is the curve's RMS. Not above zero if there is
/// none. Eight splines, or thirty-two if the rows bear them and scenes held out prefer them.
StructureScore structure_score(const Covariate& covariate, const ChannelResiduals& residuals,
                               int scenes);

/// What a scan found, best first, scenes held out one by one.
struct StructureScan {
  std::vector<StructureScore> curves;  ///< Every covariate of every channel.
  /// Something local, a bump on the board or a flaw in the field of view, hardly shows over one
  /// covariate: surfaces over the board and over azimuth and elevation (8 × 8 splines), those that
  /// predict scenes held out better than the curves of their covariates.
  std::vector<StructureScore> places;
};
StructureScan scan_structure(const MeasurementTable& table, const EveryResidual& residuals,
                             const RunContext& context);
StructureScan scan_structure(const MeasurementTable& table, const ModelState& state,
                             const std::vector<EffectInUse>& in_use, const RunContext& context);

/// Those of all scores tried that are notable, best first.
std::vector<StructureScore> notable_of(std::vector<StructureScore> scores,
                                       const DiscoveryOptions& options);
std::vector<StructureScore> notable_of(const StructureScan& scan, const DiscoveryOptions& options);

/// Whether a score, one of so many tried, is large enough to be mentioned.
bool is_notable(const StructureScore& score, std::size_t tried, const DiscoveryOptions& options);

}  // namespace lvcalib
