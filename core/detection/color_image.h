// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/error.h"

namespace lvcalib {

/// An image to look at, row by row; red, green, blue of each pixel, 8 bit each.
struct ColorImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;
};

/// Reads what read_image() reads, with its colours; 16-bit files are brought to 8 bit, alpha is
/// left out. Errors as read_image().
Result<ColorImage> read_color_image(const std::filesystem::path& path);

}  // namespace lvcalib
