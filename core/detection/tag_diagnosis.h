// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/error.h"
#include "detection/board_view.h"

namespace lvcalib {

/// Why an image shows too few of the target's tags: tags of other ids, of the other border width or
/// of another family, a mirrored image, or none at all. `found` is how many of the target's own
/// were seen.
Error explain_missing_tags(const GrayImage& image, const Target& target, int found,
                           const DetectionOptions& options, const RunContext& context);

}  // namespace lvcalib
