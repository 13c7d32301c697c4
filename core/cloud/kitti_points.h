// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <stop_token>

#include "cloud/cloud.h"

namespace lvcalib {

/// Reads a file of KITTI's velodyne_points: x, y, z and reflectance of each point as 4-byte floats
/// and nothing else. No content tells it from other files, so it is known by its name, *.bin.
/// Errors (kInput): missing, empty, no whole number of points.
Result<Cloud> read_kitti_points(const std::filesystem::path& path, std::stop_token stop = {});

}  // namespace lvcalib
