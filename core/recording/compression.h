// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/progress.h"

namespace lvcalib {

enum class Compression { kNone, kBz2, kLz4, kZstd };

/// "", "none", "bz2", "lz4", "zstd" as bags name them; nothing for another word.
std::optional<Compression> compression_by_name(std::string_view name);

/// lz4 or zstd by the first four bytes of a frame; kNone otherwise.
Compression compression_by_content(std::string_view bytes);

/// Replaces `out` by what `bytes` hold, as far as they are whole and up to `limit` bytes. True if
/// all of it came out; false if the data are damaged, cut off or hold more than `limit`. Memory
/// grows with what comes out, never with what a header claims.
bool decompress(Compression compression, std::string_view bytes, std::size_t limit,
                std::string& out);

/// Unpacks an lz4 or zstd file to `to`, in pieces. A file that is cut off gives its beginning and
/// false. Errors: reading, writing, not such a file, a stop.
Result<bool> decompress_file(const std::filesystem::path& from, const std::filesystem::path& to,
                             const RunContext& context);

}  // namespace lvcalib
