// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "base/error.h"

namespace lvcalib {

/// Size of an image as its file's header states it.
struct ImageHeader {
  long long width_px = 0;
  long long height_px = 0;
};

/// Size of a png, jpg, bmp or tiff file, and whether its structure is whole, found without
/// decoding: the decoders allocate what the header claims and print to standard error when the
/// data end early, so both are checked before they run.
/// Errors (kInput): another format, truncated or damaged structure.
Result<ImageHeader> read_image_header(std::string_view bytes);

}  // namespace lvcalib
