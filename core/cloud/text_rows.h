// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "cloud/cloud_builder.h"
#include "cloud/input.h"

namespace lvcalib {

/// Lines of a text, without their ends (LF or CR LF).
class LineReader {
 public:
  /// `before`: number of lines already consumed, for messages.
  explicit LineReader(Input& input, std::uint64_t before = 0) : input_(input), number_(before) {}

  /// The next line, valid until the next call; nothing at the end of the file.
  /// Error for a line longer than 1 MiB: then this is not a text file.
  Result<std::optional<std::string_view>> next();
  /// 1-based number of the line last returned.
  [[nodiscard]] std::uint64_t number() const { return number_; }

 private:
  Input& input_;
  std::uint64_t number_;
};

/// Cuts the next word off a line; empty at its end.
std::string_view next_word(std::string_view& line);

/// A non-negative decimal integer that takes up the whole word.
std::optional<std::uint64_t> parse_count(std::string_view word);

/// One entry of a row: which role its value has (or −1), and how many words it takes.
struct TextEntry {
  int role = -1;
  std::uint64_t words = 1;
  bool is_list = false;  ///< The word tells how many words follow.
};

/// Layout of the rows that read_text_rows() hands to the builder.
BlockLayout text_layout(const std::vector<TextEntry>& entries);

/// Reads rows of numbers, one point a line, until the builder has seen `points`. Empty lines and
/// comments (#) are passed over. Errors name the line and the field; the end of the file before
/// the last point is left to the caller.
Status read_text_rows(Input& input, LineReader& lines, const std::vector<TextEntry>& entries,
                      std::uint64_t points, CloudBuilder& builder);

/// The error for a file that ends too early.
Error truncated(const Input& input, std::uint64_t expected_points, std::uint64_t found_points);

}  // namespace lvcalib
