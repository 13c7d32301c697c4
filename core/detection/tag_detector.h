// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/error.h"
#include "detection/board_view.h"

namespace lvcalib {

/// Corners of a tag in pixels: lower left, lower right, upper right, upper left of the upright tag.
using TagCorners = std::array<Eigen::Vector2d, 4>;

/// One tag found in an image.
struct TagDetection {
  int id = 0;
  TagCorners corners;
};

/// How to search an image for tags.
struct TagSearchOptions {
  /// The image is reduced by this factor for the search for squares.
  double decimate = 1.0;
  /// Also search the enlarged image and with sharpening, for small, blurred and crowded tags.
  /// Takes about ten times as long.
  bool thorough = false;
  /// Wrong data bits that are corrected. The families differ in many more, so that two are safe.
  int max_hamming = 2;
  /// Ids of interest; all of the family if `id_count` is 0. Fewer ids are faster.
  int first_id = 0;
  int id_count = 0;
  /// Only in the passes of a thorough search: tags decoded with less margin are not believed.
  double min_margin = 20.0;
};

/// Finds all tags of a family (or markers of a dictionary, see find_markers()). `border_bits` is
/// the width of the black border: 1 (AprilTag) or 2 (Kalibr). The same id may appear more than
/// once. Corners are those of the AprilTag library (errors up to about half a pixel), see
/// refine_tag(). Errors (kUsage): unknown family, border or ids; kCancelled.
Result<std::vector<TagDetection>> find_tags(const GrayImage& image, const std::string& family,
                                            int border_bits, const TagSearchOptions& options,
                                            const RunContext& context);

}  // namespace lvcalib
