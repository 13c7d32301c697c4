// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"
#include "recording/messages.h"

namespace lvcalib {

/// An image reduced to what shows motion: means of square cells, in 1/256 of a grey level (0…255).
/// Means over hundreds of pixels hardly carry noise, and an edge that moves by a tenth of a pixel
/// still changes them.
struct ImageLook {
  int width_px = 0;  ///< Of the image.
  int height_px = 0;
  int columns = 0;
  int rows = 0;
  int cell_px = 0;
  std::vector<std::uint16_t> cells;
  /// Mean squared difference of neighbouring pixels: the larger, the sharper, between images of
  /// one scene.
  double sharpness = 0.0;
};

/// Decodes an image and reduces it. Errors name `where`: damaged data.
Result<ImageLook> look_at_image(const ImageMessage& message, const std::string& where);

/// A small picture to look at: red, green, blue, row by row.
struct Thumbnail {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;
};
/// At most `longest_px` on a side. Errors as look_at_image().
Result<Thumbnail> make_thumbnail(const ImageMessage& message, int longest_px,
                                 const std::string& where);

/// An image as a file that keeps every bit: jpeg and png as they came, everything else as png
/// (bayer and yuv422 in colours).
struct ImageFile {
  std::string extension;  ///< ".png", ".jpg", ".bmp" or ".tiff"
  std::string bytes;
};
Result<ImageFile> make_image_file(const ImageMessage& message, const std::string& where);

}  // namespace lvcalib
