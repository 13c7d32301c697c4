// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace lvcalib {

/// Reads numbers and strings one after the other from bytes that nobody has checked. What would
/// lie beyond the end reads as zero or as nothing and sets failed(), which stays set: a whole
/// record is read first and judged once.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes, bool big_endian = false)
      : bytes_(bytes), swap_(big_endian != (std::endian::native == std::endian::big)) {}

  /// Numbers start at multiples of their size, `largest` at most, counted from here on (CDR).
  /// Without this call they follow each other without gaps.
  void align_from_here(std::size_t largest) {
    origin_ = at_;
    largest_alignment_ = largest;
  }

  template <class T>
  T number() {
    static_assert(std::is_arithmetic_v<T>);
    if (largest_alignment_ > 0) align(sizeof(T));
    const std::string_view raw = take(sizeof(T));
    T value{};
    if (raw.size() != sizeof(T)) return value;
    char bytes[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes[i] = raw[swap_ ? sizeof(T) - 1 - i : i];
    }
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  /// The next bytes; nothing if fewer are left.
  std::string_view take(std::uint64_t count) {
    if (failed_ || count > left()) {
      failed_ = true;
      return {};
    }
    const std::string_view out = bytes_.substr(at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return out;
  }

  /// Bytes behind their number (32 bit).
  std::string_view block() { return take(number<std::uint32_t>()); }

  void align(std::size_t size) {
    if (size > largest_alignment_) size = largest_alignment_;
    if (size < 2) return;
    take((size - (at_ - origin_) % size) % size);
  }

  void fail() { failed_ = true; }
  [[nodiscard]] bool failed() const { return failed_; }
  [[nodiscard]] std::size_t left() const { return failed_ ? 0 : bytes_.size() - at_; }
  [[nodiscard]] std::size_t position() const { return at_; }
  [[nodiscard]] bool swaps() const { return swap_; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  std::size_t origin_ = 0;
  std::size_t largest_alignment_ = 0;
  bool swap_ = false;
  bool failed_ = false;
};

}  // namespace lvcalib
