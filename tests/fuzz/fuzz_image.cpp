// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes give pixels of the size that they claim, which a png file brings back, or an input
// error with a message; never a crash.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/image_codec.h"
#include "base/image_header.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view file(reinterpret_cast<const char*>(data), size);
  // Within the memory that a fuzzer is given.
  const auto header = lvcalib::read_image_header(file);
  constexpr long long kMost = 1'000'000;
  if (header && header->width_px > 0 && header->height_px > kMost / header->width_px) return 0;
  const auto image = lvcalib::decode_image(file);
  if (!image) {
    if (image.error().kind != lvcalib::ErrorKind::kInput || image.error().message.empty()) abort();
    return 0;
  }
  if (image->bytes.size() != image->row_bytes() * static_cast<std::size_t>(image->height_px))
    abort();
  const auto png = lvcalib::encode_png({image->width_px, image->height_px, image->channels,
                                        image->bits, image->bytes.data(), image->row_bytes()});
  if (!png) abort();
  const auto back = lvcalib::decode_image(*png);
  if (!back || back->bytes != image->bytes) abort();
  return 0;
}
