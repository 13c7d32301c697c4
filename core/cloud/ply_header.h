// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "cloud/field_decoder.h"
#include "cloud/input.h"

namespace lvcalib {

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };

struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::kF32;     ///< Of the value, or of a list's entries.
  std::optional<ScalarType> length_type;  ///< Set for a list.
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  [[nodiscard]] bool has_list() const;
  /// Bytes of a row's scalars; the whole row unless it has lists.
  [[nodiscard]] std::size_t scalar_bytes() const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  std::size_t vertex = 0;        ///< Index of the element "vertex".
  std::uint64_t line_count = 0;  ///< Lines of the header.
  [[nodiscard]] const PlyElement& vertices() const { return elements[vertex]; }
};

/// Consumes the header up to and with its end_header line. Errors name the line.
Result<PlyHeader> read_ply_header(Input& input);

}  // namespace lvcalib
