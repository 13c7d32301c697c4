// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "extrinsic/extrinsic_solver.h"
#include "extrinsic/uncertainty.h"
#include "pipeline/calibration.h"

namespace lvcalib {

/// What the joint solve takes of the scenes that `start` uses; points into `result`.
std::vector<ForwardScene> forward_scenes(const CalibrationResult& result,
                                         const std::vector<SceneObservations>& observations,
                                         const std::vector<std::size_t>& index,
                                         const ExtrinsicSolution& start);

/// The joint solve over every corner and return of the scenes that `start` uses; `index` tells
/// which scene of the result an observation is. Clouds whose intensity is missing or the same
/// everywhere take part with their ranges.
Result<ForwardSolution> solve_every_return(const CalibrationResult& result,
                                           const std::vector<SceneObservations>& observations,
                                           const std::vector<std::size_t>& index,
                                           const ExtrinsicSolution& start,
                                           const ForwardOptions& options,
                                           const RunContext& context);

/// The same observations at the forward solution: pose, covariance, board poses, residuals, the
/// influence of single scenes. What was left out stays as in `start`.
ExtrinsicSolution report_forward(const ForwardSolution& forward, const ExtrinsicSolution& start,
                                 const std::vector<SceneObservations>& observations,
                                 const Camera& camera, const Target& target,
                                 const ExtrinsicOptions& options);

/// Solves the forward model for some of the observations of `start`.
SubsetSolver forward_subsets(const ForwardSolution& forward, const ExtrinsicSolution& start);

}  // namespace lvcalib
