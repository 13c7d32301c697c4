// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "base/error.h"
#include "detection/board_view.h"

namespace lvcalib {

struct CheckerboardCorners {
  std::vector<CornerObservation> corners;
  bool other_colors = false;  ///< No frame fits the target's colours; its opposite does.
};

/// Inner corners of the target's checkerboard, to about 0.05 px, in its frame: x along the columns,
/// y along the rows, right-handed as seen from the front. Among the frames that fit the squares'
/// colours, the one whose y axis points most upwards in the image (then x to the right).
/// Errors (kInput): no checkerboard of this size (and which is there instead), or two of them;
/// kCancelled.
Result<CheckerboardCorners> find_checkerboard(const GrayImage& image, const Target& target,
                                              const RunContext& context);

}  // namespace lvcalib
