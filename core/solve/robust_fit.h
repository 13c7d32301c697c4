// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "base/message.h"
#include "solve/feature_problem.h"

namespace lvcalib {

/// A joint fit with its noise scales, after bad tags, nodes and scenes were left out.
struct RobustFit {
  JointFit fit;
  NoiseScales scales;
  ObservationMask mask;
  std::vector<Message> reasons;  ///< Per scene: why it is not used; empty if it is.
};

/// Number of scenes in use.
int count_used(const ObservationMask& mask);

/// Fewest scenes of which one can be left out with a solution remaining.
int fewest_to_leave_one_out(const Target& target);

/// Solves with re-estimated noise: σ of the corners from the corners alone; the scales of nodes and
/// planes by variance components (χ² over redundancy). Then leaves out single nodes and tags that
/// are off by more than the gate, and scenes without which the rest fits far better.
/// Errors (kUntrusted): the solve fails on these observations.
Result<RobustFit> fit_robustly(const FeatureInput& in);

}  // namespace lvcalib
