// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cloud/cloud.h"
#include "pipeline/dataset.h"
#include "pipeline/input_hashes.h"

namespace lvcalib {

struct CalibrationResult;
struct SceneResult;

/// The first earlier scene whose image, and whose cloud, has the same content as a scene's; nothing
/// where there is none.
struct SameContent {
  std::optional<std::size_t> image;
  std::optional<std::size_t> cloud;
};

/// Per scene, by the files' bytes.
std::vector<SameContent> same_content(const Dataset& dataset, bool use_crops,
                                      const std::vector<InputFile>& inputs);

/// Adds what files that differ have in common all the same, once boards have been looked for: the
/// image's corners (see same_corners()), and the returns about the board.
void find_copies(const std::vector<SceneResult>& scenes, std::vector<SameContent>& same);

/// Takes scenes that are copies out of use: a scene counts once. With another scene's image or
/// cloud alone it is not known which of the two is right: the others must tell, and the verdict
/// says so.
void note_same_content(CalibrationResult& result, const std::vector<SameContent>& same);

/// Whether more than half of the points of one cloud are in the other, too: within a tenth of a
/// millimetre, which a cloud written again as text rounds away, and with the same intensity. A
/// LiDAR's noise is ten times that at least, so that another scan of the same place meets a few of
/// the points by chance.
bool same_returns(const Cloud& a, const Cloud& b);

}  // namespace lvcalib
