// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/message.h"

namespace lvcalib {

struct CalibrationResult;

/// Where scenes have found boards in their clouds that do not agree under the given camera: whether
/// all do under another, the one that resection from these boards gives (all together are one rigid
/// body in the LiDAR's frame, whose corners the images show). In words what is wrong with the given
/// intrinsics; empty if no other camera mends it, or fewer than three scenes have both board and
/// image.
Message intrinsics_that_agree(const CalibrationResult& result);

}  // namespace lvcalib
