// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "detection/tag_detector.h"

namespace lvcalib {

/// Finds markers of one of OpenCV's predefined dictionaries (marker_dictionaries()); ids, corners
/// and options as for find_tags(), which comes here for such families. The corners are those of the
/// contours, to about a pixel; see refine_tag(). A thorough search also looks at the enlarged image
/// and for smaller markers. What is decoded has at most as many wrong bits as the dictionary can
/// correct; with options.max_hamming of 0, none.
/// Errors (kUsage): unknown dictionary; kCancelled.
Result<std::vector<TagDetection>> find_markers(const GrayImage& image,
                                               const std::string& dictionary, int border_bits,
                                               const TagSearchOptions& options,
                                               const RunContext& context);

}  // namespace lvcalib
