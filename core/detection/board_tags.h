// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "base/error.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "detection/board_view.h"
#include "detection/tag_detector.h"

namespace lvcalib {

/// A tag of the board with the state of its corners.
struct BoardTag {
  int id = 0;
  TagCorners corners;
  std::array<double, 4> sigma_px{};  ///< Of each corner's coordinates.
  bool refined = false;
  double contrast = 0.0;  ///< Grey levels; 0 unless refined.
};

/// Tags that an image must show: options.min_tags, or all if the board has fewer.
int fewest_tags(const Target& target, const DetectionOptions& options);

/// The target's tags in an image, corners refined; an id may appear more than once.
/// A quick search first; a thorough one if it leaves fewer than fewest_tags().
/// Errors: kCancelled.
Result<std::vector<BoardTag>> find_board_tags(const GrayImage& image, const Target& target,
                                              const Camera& camera, const DetectionOptions& options,
                                              const RunContext& context);

/// Looks again, where `camera_from_board` puts them, for the tags that are missing or could not be
/// refined: partly hidden, small or blurred ones that the search for squares does not see. What is
/// added fits the image well and has the contrast of the others.
void complete_board_tags(std::vector<BoardTag>& tags, const GrayImage& image, const Target& target,
                         const Camera& camera, const Rigid3& camera_from_board,
                         const RunContext& context);

/// The tags' corners as observations.
std::vector<CornerObservation> to_observations(const std::vector<BoardTag>& tags,
                                               const Target& target);

}  // namespace lvcalib
