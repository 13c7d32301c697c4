// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "base/rigid3.h"
#include "cloud/cloud.h"
#include "localization/pattern_template.h"
#include "localization/planar_patch.h"
#include "target/target.h"

namespace lvcalib {

/// A place where the board may be in one cloud, in one symmetric assignment.
struct BoardCandidate {
  /// Pose with the covariance of its left perturbation (LiDAR frame).
  UncertainRigid3 lidar_from_board;
  double gain = 0.0;         ///< Evidence in nats; see PatternMatch::gain.
  double correlation = 0.0;  ///< Intensity against albedo; 0 when found by its outline alone.
  double scale = 1.0;        ///< Pattern size measured by the LiDAR over the model's.
  double scale_sigma = 0.0;
  std::size_t patch = 0;  ///< Index into BoardSearchResult::patch_points.
};

struct BoardSearchOptions {
  double min_range_m = 0.3;        ///< Closer points (the rig itself) are ignored.
  double max_lever_arm_m = 5.0;    ///< Largest believable distance between camera and LiDAR.
  double min_correlation = 0.6;    ///< Pattern correlation below this is not the board.
  double plane_tolerance_m = 0.0;  ///< 0: from the measured noise.
  int max_patches = 6;             ///< Patches examined at full density.
  bool search_walls = false;       ///< Also look for the pattern on planes larger than the board.
};

/// Where to look, when a rough extrinsic or a crop is given.
struct BoardSearchRegion {
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();
  double radius_m = 0.0;
  std::optional<Eigen::Vector3d> width =
      std::nullopt;  ///< Where the board's width points, if that is known.
};

struct BoardSearchResult {
  std::vector<BoardCandidate> candidates;  ///< Best first.
  std::vector<Cloud> patch_points;  ///< Full-density points about each patch with a candidate.
  int patches = 0;                  ///< Flat patches of about the board's size.
  double best_correlation = 0.0;    ///< Of any patch, accepted or not.
};

/// Blurred patterns of one target, coarse to fine; built once and shared by all scenes.
struct PatternPyramid {
  explicit PatternPyramid(const Target& target);
  std::vector<PatternTemplate> levels;
};

/// What is looked for, and where.
struct BoardSought {
  const Target& target;
  const PatternPyramid& pyramid;   ///< Of the target.
  double camera_distance_m = 0.0;  ///< From the camera to the board.
  std::optional<BoardSearchRegion> region = {};
};

/// Looks for the board in a cloud without any initial guess: flat patches of about its size, in
/// which the intensity follows the printed pattern (checkerboards and clouds whose intensity is
/// missing or the same everywhere: whose outline fits).
BoardSearchResult search_board(const Cloud& cloud, const BoardSought& sought,
                               const BoardSearchOptions& options, const RunContext& context);

/// Where the board most likely stands, for a first look at a cloud before anything is calibrated:
/// what search_board() finds first within 25 m, where a board of a metre still has some hundred
/// returns. None where there is nothing like it, or if stopped.
std::optional<Rigid3> likely_board(const Cloud& cloud, const Target& target,
                                   const RunContext& context);

/// True if the board's pattern, not only its outline, can be looked for.
bool matches_by_pattern(const Target& target, const Cloud& cloud);

}  // namespace lvcalib
