// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"
#include "cloud/input.h"

namespace lvcalib {

enum class PcdData { kAscii, kBinary, kBinaryCompressed };

struct PcdField {
  std::string name;  ///< "_" is padding.
  std::size_t size = 0;
  char type = 'F';
  std::size_t count = 1;
  [[nodiscard]] std::size_t bytes() const { return size * count; }
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t points = 0;
  std::uint64_t rows = 1;  ///< HEIGHT, if WIDTH is there as well; 1 otherwise.
  PcdData data = PcdData::kAscii;
  std::uint64_t line_count = 0;  ///< Lines of the header.
  [[nodiscard]] std::size_t point_bytes() const;
};

/// Consumes the header up to and with its DATA line. VERSION is ignored, a VIEWPOINT other than the
/// origin refused; COUNT and either of POINTS and WIDTH × HEIGHT may be missing. Errors name the
/// line.
Result<PcdHeader> read_pcd_header(Input& input);

}  // namespace lvcalib
