// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/robust_fit.h"

namespace lvcalib {

/// Turns a finished fit into what users are told: residuals per scene, corner and node, covariance
/// with rank and weak directions and, if asked for, the influence of leaving one scene out.
ExtrinsicSolution report_solution(const RobustFit& fit, const FeatureInput& in,
                                  bool leave_one_out = true);

}  // namespace lvcalib
