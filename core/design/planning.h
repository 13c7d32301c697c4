// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "design/lidar_file.h"

namespace lvcalib {

struct PlanOptions {
  int scenes = 6;                    ///< 1 … 100.
  std::vector<std::string> effects;  ///< Of the catalogue: to be made testable as well.
  double testable = 3.0;             ///< The size of interest is to stand so many σ above zero.
  double corner_sigma_px = 0.05;
  /// What is known of the extrinsic before: its covariance (left perturbation, camera frame; metres
  /// and radians), as the result of scenes that are taken states it. Absent: nothing. Of effects
  /// nothing is taken to be known.
  std::optional<Matrix6d> known;
  /// Where the board was in scenes that are taken (camera_from_board). The pose of the grid that is
  /// nearest to each, by how far the board's corners lie apart, is not proposed again.
  std::vector<Rigid3> taken;
  BoardGridOptions grid;
  [[nodiscard]] Status check() const;
};

/// How far an effect's size of interest stands above zero.
struct EffectVisibility {
  std::string id;
  double sigmas = 0.0;
};

/// A board pose to take, with what is known once it is taken.
struct PlannedScene {
  GridPose pose;
  Rigid3 lidar_from_board;
  bool determined = false;                 ///< All six directions of the extrinsic are.
  Matrix6d covariance = Matrix6d::Zero();  ///< Of the extrinsic: left perturbation, camera frame.
  std::vector<EffectVisibility> effects;
};

struct ScenePlan {
  std::vector<PlannedScene> scenes;
  Rigid3 camera_from_lidar;       ///< That the plan was made with.
  std::optional<Matrix6d> known;  ///< What was known before (see PlanOptions).
  std::size_t poses_tried = 0;    ///< Of the grid: those that both sensors see.
  std::vector<Message> warnings;  ///< Effects that stay untestable.
};

/// Chooses board poses one after the other from a grid, each the one that most reduces the volume
/// of the extrinsic's uncertainty (D-optimality) and lifts the wanted effects' sizes of interest
/// above `testable` σ. The covariance is that of the measurements' noise alone, as calibrate states
/// it. Errors: kUsage for options and unknown effects; kInput if an effect needs what the LiDAR or
/// the board lacks, or if no pose of the grid is in view of both sensors; kCancelled.
Result<ScenePlan> plan_scenes(const Target& target, const Camera& camera,
                              const LidarDescription& lidar, const PlanOptions& options,
                              const RunContext& context);

}  // namespace lvcalib
