// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace lvcalib {

/// What the user calls the frames of the two sensors: letters, digits and _ - . / (see
/// check_frame_name()).
struct FrameNames {
  std::string lidar = "lidar";
  std::string camera = "camera";
  bool operator==(const FrameNames&) const = default;
};

}  // namespace lvcalib
