// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "base/rigid3.h"
#include "localization/board_search.h"

namespace lvcalib {

/// What one scene brings to the joint decision: the board as the camera sees it (and, for an
/// ambiguous planar pose, the other reading) and where it may be in the cloud.
struct SceneHypotheses {
  UncertainRigid3 camera_from_board;
  std::optional<Rigid3> alternative_camera_from_board;
  std::vector<BoardCandidate> candidates;
  Eigen::Vector2d board_middle_m = Eigen::Vector2d::Zero();
};

/// The extrinsic that the scenes agree on.
struct SceneConsensus {
  UncertainRigid3 camera_from_lidar;
  /// Per scene: the candidate that agrees with it, or nothing.
  std::vector<std::optional<std::size_t>> chosen;
  double score = 0.0;      ///< Evidence in nats.
  double runner_up = 0.0;  ///< Evidence of the best extrinsic that contradicts it.
  /// Evidence of the best extrinsic that puts the boards elsewhere into the clouds, of these boards
  /// alone. Of another reading of the same board there is none.
  double elsewhere = 0.0;
  int agreeing = 0;
  [[nodiscard]] double margin() const { return score - runner_up; }
};

struct ConsensusOptions {
  /// Systematic part of each scene's estimate that its covariance does not hold.
  double systematic_rotation_rad = 0.01;
  double systematic_translation_m = 0.01;
  /// Only extrinsics this near to the guess are considered, when one is given.
  double guess_translation_m = 0.5;
  double guess_rotation_rad = 0.35;
};

/// Every candidate of every scene proposes an extrinsic; the one with the most evidence over all
/// scenes wins. Nothing if there is no candidate at all (or none near the guess).
std::optional<SceneConsensus> decide_scenes(const std::vector<SceneHypotheses>& scenes,
                                            const std::optional<Rigid3>& guess,
                                            const ConsensusOptions& options);

}  // namespace lvcalib
