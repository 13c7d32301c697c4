// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace lvcalib {

/// Pixels in memory: rows from the top, channels side by side.
struct PixelView {
  int width_px = 0;
  int height_px = 0;
  int channels = 1;  ///< 1 grey; 2 grey and alpha; 3 red, green, blue; 4 those and alpha.
  int bits = 8;      ///< Per channel: 8, or 16 in the machine's byte order.
  const std::uint8_t* data = nullptr;
  std::size_t row_bytes = 0;  ///< From one row to the next.
};

/// An image as its file holds it.
struct DecodedImage {
  int width_px = 0;
  int height_px = 0;
  int channels = 1;  ///< As in PixelView.
  int bits = 8;      ///< As in PixelView.
  std::vector<std::uint8_t> bytes;

  [[nodiscard]] std::size_t row_bytes() const {
    return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(channels * bits / 8);
  }
};

/// Decodes a png, jpg, bmp or tiff file: colour, grey, palette, with alpha, 8 or 16 bit. By libpng,
/// libjpeg and libtiff themselves, as OpenCV's image files load GDAL and a hundred libraries
/// besides, which costs every start of a program 60 ms and 20 MB. Transparency of a palette is left
/// out; so is what the file says of its orientation, but for tiff. Errors (kInput): another format,
/// damaged data, more than 200 million pixels, floating point. Throws std::bad_alloc where memory
/// does not suffice.
Result<DecodedImage> decode_image(std::string_view file);

/// A png file, compressed fast: noise does not compress, and the fastest level is as small as the
/// slowest within a few percent. Errors (kOutput): no pixels.
Result<std::string> encode_png(const PixelView& pixels);

/// A jpg file of 8-bit grey pixels, of a quality from 1 to 100. Errors (kOutput): no such pixels.
Result<std::string> encode_grey_jpeg(const PixelView& pixels, int quality);

}  // namespace lvcalib
