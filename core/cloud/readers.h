// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/error.h"
#include "cloud/cloud.h"
#include "cloud/cloud_builder.h"
#include "cloud/input.h"

namespace lvcalib {

// Why not PCL's readers (1.13): a PCD of 300 bytes whose header claims 2·10⁹ points makes them ask
// for the memory, one whose 50 compressed bytes claim to hold 4 GB keeps them busy for 14 s
// with 3.9 GB, and a word that is no number ends a file of text without saying where. Half a
// million points take 4 ms of our time and 13 ms (PCD) or 52 ms (PLY) of theirs (pcl_benchmark),
// and their library brings VTK into every program.

/// Reads a PCD file from its first byte on.
Result<Cloud> read_pcd(Input& input, PointChoice choice = PointChoice::kReturns,
                       std::uint64_t max_unpacked_bytes = kMaxUnpackedBytes);

/// Reads a PLY file from its first byte on; points come from the element "vertex".
Result<Cloud> read_ply(Input& input, PointChoice choice = PointChoice::kReturns);

/// After the last point: warns in `cloud` of what follows there. Zeros and white space are padding
/// that writers leave behind and nobody misses; anything else is data that the header does not
/// count.
Status look_behind_points(Input& input, std::uint64_t points, Cloud& cloud);

/// Feeds `points` fixed-size points to the builder, chunk by chunk.
Status read_binary_points(Input& input, std::size_t point_bytes, std::uint64_t points,
                          CloudBuilder& builder);

}  // namespace lvcalib
