// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/calibration.h"
#include "pipeline/stage_cache.h"

namespace lvcalib {

/// A scene's cloud as the request wants it: board.pcd or cloud.pcd, cut by its crop box, with or
/// without its intensities.
Result<Cloud> read_scene_cloud(const SceneFiles& files, const CalibrationRequest& request,
                               std::stop_token stop);

/// The stages that look at one scene alone: image → board view, cloud → board candidates. Runs
/// all scenes, images first, on the context's threads; keeps only the points about the
/// candidates, so that no more clouds than threads are in memory at once.
/// With a `cache` (prepared for the dataset), stages made from the same things are not run again.
/// Errors: the first unusable file.
Status load_scenes(const Dataset& dataset, const CalibrationRequest& request,
                   const RunContext& context, CalibrationResult& result,
                   StageCache* cache = nullptr);

/// Looks at the images of intrinsics/ and puts what they show into the result's intrinsics. Those
/// that cannot be read, show no board or are there already as a scene's are left out with a
/// warning. Errors: kCancelled.
Status load_extra_images(const Dataset& dataset, const CalibrationRequest& request,
                         const RunContext& context, CalibrationResult& result,
                         StageCache* cache = nullptr);

/// Where and for what to look once more. Refers to all of it.
struct SecondSearch {
  const SceneFiles& files;
  const CalibrationRequest& request;
  const BoardSearchRegion& region;
  const Target& target;
  const PatternPyramid& pyramid;  ///< Of the target.
};

/// Reads one scene's cloud (or crop) and searches the board in it once more, in a region.
/// What is found has taken the place of scene.search; if nothing is, that stays as it was.
Status search_scene_again(const SecondSearch& where, const RunContext& context, SceneResult& scene,
                          StageCache* cache = nullptr);

/// What the LiDAR measures where the board should stand with its middle at `center_m` (LiDAR
/// frame): the rays end behind the place, before it, or on it (or too few of them tell).
BoardPlace look_at_place(const Cloud& cloud, const Eigen::Vector3d& center_m, const Target& target);

}  // namespace lvcalib
