// SPDX-License-Identifier: BSD-3-Clause
// Images that are turned: by a driver that knows how the camera hangs, or by a viewer that wrote
// them again.
#pragma once

#include <optional>
#include <vector>

#include "camera/camera.h"
#include "detection/board_view.h"
#include "localization/scene_consensus.h"
#include "target/target.h"

namespace lvcalib {

struct CalibrationResult;
struct SceneResult;

/// By how many degrees an image may be turned counterclockwise and still have the camera's size.
std::vector<int> possible_turns_deg(const Camera& camera);

/// Where an image's corners are once it is turned counterclockwise by a multiple of 90°.
std::vector<CornerObservation> turned_corners(std::vector<CornerObservation> corners,
                                              const Camera& camera, int degrees);

/// Two groups of scenes whose images are turned against each other.
struct TurnedImages {
  int degrees = 0;                  ///< Counterclockwise, that turns `scenes` as `others` are.
  std::vector<std::size_t> scenes;  ///< Those that do not agree with the consensus; never all.
  std::vector<std::size_t> others;
  /// 2 ln L by which the corners of all images fit the given intrinsics better with `scenes` turned
  /// than with `others` turned the other way: principal point and distortion lie on one side.
  /// About 0 where they lie in the middle.
  double for_others = 0.0;
};

/// After scenes have found boards that do not agree: whether all of them do once the images of
/// those that do not are turned. `hypotheses` per scene; `chosen` of their consensus.
std::optional<TurnedImages> turned_images(const std::vector<SceneResult>& scenes,
                                          std::vector<SceneHypotheses> hypotheses,
                                          const std::vector<std::optional<std::size_t>>& chosen,
                                          const Camera& camera, const DetectionOptions& detection,
                                          const ConsensusOptions& options);

/// Says so of the scenes that are turned, which then contradict the others. Those are the ones
/// that the given intrinsics do not fit as they are; where these cannot tell, the fewer ones, or
/// (`has_guess`) those that contradict the rough extrinsic. Of two halves that nothing tells apart
/// none is called wrong: the second is left out, and both are named. True if there are any.
bool note_turned_images(CalibrationResult& result, const std::vector<SceneHypotheses>& hypotheses,
                        const SceneConsensus& consensus, bool has_guess);

}  // namespace lvcalib
