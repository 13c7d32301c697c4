// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/error.h"
#include "detection/board_tags.h"
#include "detection/board_view.h"

namespace lvcalib {

/// Why an image shows too few of the target's tags: tags of other ids, of the other border width or
/// of another family, a mirrored image, or none at all. `found` is how many of the target's own
/// were seen.
Error explain_missing_tags(const GrayImage& image, const Target& target, int found,
                           const DetectionOptions& options, const RunContext& context);

/// How many of the target's tags can be read, without a fault, in the mirrored image. Of small
/// dictionaries some can be misread in either.
std::size_t tags_in_mirror(const GrayImage& image, const Target& target,
                           const DetectionOptions& options, const RunContext& context);

/// No checkerboard is found: the error that names the tags or markers which the image shows
/// instead, if there are three or more of one kind.
std::optional<Error> tags_instead_of_checkerboard(const GrayImage& image,
                                                  const DetectionOptions& options,
                                                  const RunContext& context);

/// Where the target's family is one of few bits, which are misread into other tags now and then:
/// the error that names another family of which the image shows more than `found` tags.
std::optional<Error> other_tag_family(const GrayImage& image, const Target& target,
                                      std::size_t found, const DetectionOptions& options,
                                      const RunContext& context);

/// The image, or the print, is mirrored.
Error explain_mirrored();

/// "the image shows tags 8, 9 of tag36h11; the target has 0 to 3; all of them fit with
/// firstTagId: 8". `fields`: of target.yaml, see other_grid().
Message tags_that_fit_with(const Message& fields, const std::vector<BoardTag>& seen,
                           const Target& target);

/// Every tag of the target's family that the image shows without a wrong bit, also those that the
/// target does not have. None where the search is stopped.
std::vector<BoardTag> all_tags_of_family(const GrayImage& image, const Target& target,
                                         const DetectionOptions& options,
                                         const RunContext& context);

}  // namespace lvcalib
