// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/progress.h"
#include "pipeline/dataset.h"

namespace lvcalib {

/// A file that went into a result.
struct InputFile {
  std::string path;    ///< Relative to the dataset.
  std::string sha256;  ///< 64 hexadecimal digits; empty if it could no longer be read.
  std::uint64_t bytes = 0;
};

/// SHA-256 of the dataset's descriptions, images and clouds, so that a result can be traced to
/// exactly what it was made of. Runs on the context's threads; ends early when stopped.
std::vector<InputFile> hash_inputs(const Dataset& dataset, bool use_crops,
                                   const RunContext& context);

/// SHA-256 of one file; false if it cannot be read or the context is stopped.
bool hash_file(const std::filesystem::path& path, const RunContext& context, InputFile& out);

}  // namespace lvcalib
