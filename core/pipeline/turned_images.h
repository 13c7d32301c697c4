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

/// Scenes whose images are turned against those of the others.
struct TurnedImages {
  int degrees = 0;                  ///< Counterclockwise, that turns them back.
  std::vector<std::size_t> scenes;  ///< Never all.
};

/// After scenes have found boards that do not agree: whether all of them do once the images of
/// those that do not are turned. `hypotheses` per scene; `chosen` of their consensus.
std::optional<TurnedImages> turned_images(const std::vector<SceneResult>& scenes,
                                          std::vector<SceneHypotheses> hypotheses,
                                          const std::vector<std::optional<std::size_t>>& chosen,
                                          const Camera& camera, const DetectionOptions& detection,
                                          const ConsensusOptions& options);

/// Says so of these scenes, which then contradict the others.
void note_turned_images(CalibrationResult& result, const std::vector<SceneHypotheses>& hypotheses,
                        const SceneConsensus& consensus);

}  // namespace lvcalib
