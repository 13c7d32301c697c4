// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "base/message.h"
#include "camera/camera.h"
#include "detection/board_tags.h"

namespace lvcalib {

/// How the tags of a grid lie if not as the target has them: counted from another corner, each one
/// turned on its place (as some programs draw AprilTags), or both. In words that complete "the tags
/// fit a board …"; nothing if no such arrangement fits at least three quarters of the tags, and
/// three.
std::optional<Message> other_arrangement(const std::vector<BoardTag>& tags, const Target& target,
                                         const Camera& camera, const DetectionOptions& options);

/// Fields of target.yaml with which at least three quarters of the tags, and three more than with
/// the present ones, lie where the target has them: "firstTagId: 0", "tagCols: 4",
/// "tagSpacing: 0.833"; of a ChArUco board "firstMarkerId: 0", "targetCols: 8". `tags` may hold ids
/// that the target does not have. Nothing for other boards, or if nothing fits so well.
std::optional<Message> other_grid(const std::vector<BoardTag>& tags, const Target& target,
                                  const Camera& camera, const DetectionOptions& options);

}  // namespace lvcalib
