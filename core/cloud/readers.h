// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/error.h"
#include "cloud/cloud.h"
#include "cloud/cloud_builder.h"
#include "cloud/input.h"

namespace lvcalib {

/// Reads a PCD file from its first byte on.
Result<Cloud> read_pcd(Input& input, PointChoice choice = PointChoice::kReturns);

/// Reads a PLY file from its first byte on; points come from the element "vertex".
Result<Cloud> read_ply(Input& input, PointChoice choice = PointChoice::kReturns);

/// Feeds `points` fixed-size points to the builder, chunk by chunk.
Status read_binary_points(Input& input, std::size_t point_bytes, std::uint64_t points,
                          CloudBuilder& builder);

}  // namespace lvcalib
