// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "discovery/effect_search.h"

namespace lvcalib {

/// Information about extrinsic (6) and effect columns, and which of them belong to which effect.
struct InformationBlock {
  Eigen::Index first = 0;
  Eigen::Index count = 0;
};

/// Squared signal-to-noise of an effect of size `values` in the unknowns of `mine`, when extrinsic
/// and the unknowns of `rest` adapt: θᵀ(H_mm − H_mr H_rr⁻¹ H_rm)θ.
double noncentrality(const Eigen::MatrixXd& information, const InformationBlock& mine,
                     const std::vector<InformationBlock>& rest, const Eigen::VectorXd& values);

/// Symmetric T-optimality of telling A (size `values`) from B: the mean of what remains of A when B
/// may mimic it, and of that B which mimics A best now when A may mimic it (Atkinson and Fedorov
/// 1975).
double t_optimality(const Eigen::MatrixXd& now, const Eigen::MatrixXd& with_scene,
                    const InformationBlock& a, const InformationBlock& b,
                    const std::vector<InformationBlock>& rest, const Eigen::VectorXd& values);

/// Board poses worth taking, in words, computed over a grid of poses: to tell effects from their
/// aliases, to see effects that could move the extrinsic unseen, and to shrink the extrinsic's
/// weakest direction. Where no pose helps it says so and names what to measure instead. rank() must
/// have run on the final model. Empty when stopped.
std::vector<std::string> advise_scenes(const EffectSearch& search,
                                       const std::vector<EffectFinding>& findings,
                                       const DiscoveryOptions& options, const RunContext& context);

}  // namespace lvcalib
