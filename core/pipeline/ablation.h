// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "pipeline/calibration.h"

namespace lvcalib {

/// The scenes of a joint solve with their nodes as the paper refines them. `index` says which of
/// the result's scenes each of them is.
std::vector<SceneObservations> with_paper_nodes(std::vector<SceneObservations> observations,
                                                const CalibrationResult& result,
                                                const std::vector<std::size_t>& index);

/// What each departure from the paper's method is worth: beginning with the paper's own, each is
/// switched on in turn, up to the joint solve and the forward model. All are measured like the
/// result's methods, of which the first and the last ones are taken. Boards without circles have
/// only the last ones. `nodes` is the joint solve on these observations.
/// Errors: kCancelled.
Result<std::vector<AblationStep>> ablate(const CalibrationResult& result,
                                         const std::vector<SceneObservations>& observations,
                                         const std::vector<std::size_t>& index,
                                         const Target& target, const ExtrinsicSolution& nodes,
                                         const RunContext& context);

}  // namespace lvcalib
