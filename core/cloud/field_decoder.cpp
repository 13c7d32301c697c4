// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/field_decoder.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace lvcalib {
namespace {

template <class T, bool kSwap>
T load(const char* at) {
  T value;
  if constexpr (kSwap && sizeof(T) > 1) {
    char bytes[sizeof(T)];
    std::reverse_copy(at, at + sizeof(T), bytes);
    std::memcpy(&value, bytes, sizeof(T));
  } else {
    std::memcpy(&value, at, sizeof(T));
  }
  return value;
}

// Calls work.template operator()<T>() with the C++ type of a scalar type.
template <class Work>
auto with_type(ScalarType type, const Work& work) {
  switch (type) {
    case ScalarType::kI8:
      return work.template operator()<std::int8_t>();
    case ScalarType::kU8:
      return work.template operator()<std::uint8_t>();
    case ScalarType::kI16:
      return work.template operator()<std::int16_t>();
    case ScalarType::kU16:
      return work.template operator()<std::uint16_t>();
    case ScalarType::kI32:
      return work.template operator()<std::int32_t>();
    case ScalarType::kU32:
      return work.template operator()<std::uint32_t>();
    case ScalarType::kI64:
      return work.template operator()<std::int64_t>();
    case ScalarType::kU64:
      return work.template operator()<std::uint64_t>();
    case ScalarType::kF32:
      return work.template operator()<float>();
    case ScalarType::kF64:
      break;
  }
  return work.template operator()<double>();
}

// The type and the byte order are chosen once per block, not once per value.
template <class Out, class Convert>
void decode(const char* block, const FieldLayout& field, bool swap_bytes, std::size_t count,
            Out* out, const Convert& convert) {
  const char* at = block + field.offset;
  const std::size_t stride = field.stride;
  with_type(field.type, [&]<class T>() {
    if (swap_bytes) {
      for (std::size_t i = 0; i < count; ++i) out[i] = convert(load<T, true>(at + i * stride));
    } else {
      for (std::size_t i = 0; i < count; ++i) out[i] = convert(load<T, false>(at + i * stride));
    }
  });
}

struct ToLine {
  template <class T>
  std::uint16_t operator()(T value) const {
    // Written so that NaN, too, ends at zero.
    if (!(value > T{0})) return 0;
    if constexpr (sizeof(T) > 2 || std::is_floating_point_v<T>) {
      if (value >= T{65535}) return 65535;
    }
    return static_cast<std::uint16_t>(value);
  }
};

struct ToDifference {
  ExactTime first;
  template <class T>
  float operator()(T value) const {
    if constexpr (std::is_integral_v<T>) {
      const std::uint64_t difference = static_cast<std::uint64_t>(value) - first.ticks;
      return static_cast<float>(static_cast<std::int64_t>(difference));
    } else {
      return static_cast<float>(static_cast<double>(value) - first.value);
    }
  }
};

}  // namespace

std::size_t scalar_size(ScalarType type) {
  return with_type(type, []<class T>() { return sizeof(T); });
}

bool is_integer(ScalarType type) {
  return with_type(type, []<class T>() { return std::is_integral_v<T>; });
}

std::optional<ScalarType> pcd_scalar_type(char letter, std::size_t size) {
  using enum ScalarType;
  if (letter == 'F') {
    if (size == 4) return kF32;
    if (size == 8) return kF64;
  } else if (letter == 'I' || letter == 'U') {
    const bool is_signed = letter == 'I';
    if (size == 1) return is_signed ? kI8 : kU8;
    if (size == 2) return is_signed ? kI16 : kU16;
    if (size == 4) return is_signed ? kI32 : kU32;
    if (size == 8) return is_signed ? kI64 : kU64;
  }
  return std::nullopt;
}

void decode_floats(const char* block, const FieldLayout& field, bool swap_bytes, std::size_t count,
                   float* out) {
  decode(block, field, swap_bytes, count, out,
         [](auto value) { return static_cast<float>(value); });
}

void decode_lines(const char* block, const FieldLayout& field, bool swap_bytes, std::size_t count,
                  std::uint16_t* out) {
  decode(block, field, swap_bytes, count, out, ToLine{});
}

ExactTime decode_time(const char* block, const FieldLayout& field, bool swap_bytes,
                      std::size_t index) {
  const char* at = block + field.offset + index * field.stride;
  return with_type(field.type, [&]<class T>() {
    const T value = swap_bytes ? load<T, true>(at) : load<T, false>(at);
    ExactTime time;
    time.value = static_cast<double>(value);
    if constexpr (std::is_integral_v<T>) {
      time.ticks = static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
    }
    return time;
  });
}

void decode_times(const char* block, const FieldLayout& field, bool swap_bytes, std::size_t count,
                  const ExactTime& first, float* out) {
  decode(block, field, swap_bytes, count, out, ToDifference{first});
}

double decode_scalar(const char* at, ScalarType type, bool swap_bytes) {
  return decode_time(at, {type, 0, 0}, swap_bytes, 0).value;
}

}  // namespace lvcalib
