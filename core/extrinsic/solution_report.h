// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "extrinsic/robust_fit.h"

namespace lvcalib {

/// Turns a finished fit into what users are told: residuals per scene, corner and node, covariance
/// with rank and weak directions, leave-one-out influence.
ExtrinsicSolution report_solution(const RobustFit& fit,
                                  const std::vector<SceneObservations>& scenes,
                                  const Camera& camera, const Target& target,
                                  const ExtrinsicOptions& options);

}  // namespace lvcalib
