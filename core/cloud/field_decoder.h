// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "cloud/field_names.h"

namespace lvcalib {

enum class ScalarType { kI8, kU8, kI16, kU16, kI32, kU32, kI64, kU64, kF32, kF64 };

std::size_t scalar_size(ScalarType type);
bool is_integer(ScalarType type);
/// The type of PCD's TYPE letter (I, U, F) and SIZE; nothing if there is none.
std::optional<ScalarType> pcd_scalar_type(char letter, std::size_t size);

/// Where the values of one field lie in a block: value k starts at offset + k·stride.
struct FieldLayout {
  ScalarType type = ScalarType::kF32;
  std::size_t offset = 0;
  std::size_t stride = 0;
};

/// Where each role's values lie; nothing for a role that the file lacks.
/// With point-by-point data all strides are the size of a point, with column-by-column data
/// each is the size of its field.
struct BlockLayout {
  std::array<std::optional<FieldLayout>, kRoleCount> fields;
  bool swap_bytes = false;  ///< The data have the other byte order than this machine.
};

/// Converts `count` values of a field from `block` on. Integers become the nearest float.
void decode_floats(const char* block, const FieldLayout& field, bool swap_bytes, std::size_t count,
                   float* out);

/// The same to 16-bit unsigned numbers: fractions are cut off, values beyond the range give its
/// end, NaN gives 0.
void decode_lines(const char* block, const FieldLayout& field, bool swap_bytes, std::size_t count,
                  std::uint16_t* out);

/// A time as exact as the file has it: 64-bit nanoseconds since 1970 do not fit a double.
struct ExactTime {
  std::uint64_t ticks = 0;  ///< For integer types, in two's complement.
  double value = 0.0;       ///< For every type.
};

/// Value `index` of a field.
ExactTime decode_time(const char* block, const FieldLayout& field, bool swap_bytes,
                      std::size_t index);

/// Differences to `first` in the field's own unit; integers are subtracted before they are
/// rounded to float.
void decode_times(const char* block, const FieldLayout& field, bool swap_bytes, std::size_t count,
                  const ExactTime& first, float* out);

/// One value of any type, as a double.
double decode_scalar(const char* at, ScalarType type, bool swap_bytes);

}  // namespace lvcalib
