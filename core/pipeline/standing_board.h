// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "localization/board_search.h"

namespace lvcalib {

/// A board that no search finds, as few lines or points show it, where image and other scenes put
/// it (`lidar_from_board`, to some centimetres): if returns lie on one plane over half of its
/// outline, near that pose, and not as densely beside it. One candidate, of little weight against
/// others, and the points about it; nothing if nothing flat of the board's size stands there.
std::optional<BoardSearchResult> find_standing_board(const Cloud& cloud, const Target& target,
                                                     const Rigid3& lidar_from_board);

}  // namespace lvcalib
