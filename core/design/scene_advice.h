// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "design/board_grid.h"
#include "model/mixed_model.h"

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

/// The scenes taken: their measurements and the model fitted to them, with other effects beside it.
struct ScenesTaken {
  const MeasurementTable& table;
  const ModelState& state;
  const std::vector<EffectInUse>& in_use;
  const Linearization& linear;  ///< Columns of `in_use` first, in their order.
  const ModelVariances& variances;
};

/// An effect of the model and one beside it that the scenes taken cannot tell apart; their places
/// in the linearisation's list.
struct AliasedPair {
  std::size_t in_use = 0;
  std::size_t alias = 0;
};

/// An effect that may be there unseen, its place in the linearisation's list, and how far it could
/// move the extrinsic.
struct UnseenEffect {
  std::size_t effect = 0;
  double extrinsic_move_mm = 0.0;
  double extrinsic_move_mrad = 0.0;
};

/// What one more scene is to tell.
struct OpenQuestions {
  std::vector<AliasedPair> aliased;
  std::vector<UnseenEffect> unseen;
};

/// Board poses worth taking, in words, computed over a grid of poses: to tell effects from their
/// aliases, to see effects that could move the extrinsic unseen, and to shrink the extrinsic's
/// weakest direction. Where no pose helps it says so and names what to measure instead. Empty when
/// stopped.
std::vector<Message> advise_scenes(const ScenesTaken& taken, const OpenQuestions& questions,
                                   const BoardGridOptions& grid, const RunContext& context);

}  // namespace lvcalib
