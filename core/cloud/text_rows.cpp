// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/text_rows.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

namespace lvcalib {
namespace {

constexpr std::size_t kLongestLine = std::size_t{1} << 20;
constexpr std::size_t kRowsPerBlock = 1024;
using Row = std::array<double, kRoleCount>;

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

bool parse_value(std::string_view word, double& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const auto [stop, code] = std::from_chars(word.data(), end, value);
  if (stop != end || word.empty()) return false;
  // Too large or too small for a double: no coordinate.
  if (code == std::errc::result_out_of_range) value = std::numeric_limits<double>::quiet_NaN();
  return code == std::errc{} || code == std::errc::result_out_of_range;
}

// A row as it is taken apart, with what its errors need.
struct RowParser {
  const Input& input;
  std::uint64_t line_number;
  std::string_view line;

  [[nodiscard]] Error error(const std::string& message) const {
    return input.error(Message("line %1: %2", line_number, message));
  }

  // Passes over `words` words; false at the end of the line.
  bool skip(std::uint64_t words) {
    for (; words > 0; --words) {
      if (next_word(line).empty()) return false;
    }
    return true;
  }

  Status parse(const std::vector<TextEntry>& entries, Row& row) {
    std::uint64_t column = 0;
    for (const TextEntry& entry : entries) {
      const std::string_view word = next_word(line);
      if (word.empty()) {
        return error("ends after " + std::to_string(column) + " values, expected more");
      }
      std::uint64_t more = entry.words - 1;
      if (entry.is_list) {
        const auto length = parse_count(word);
        if (!length) return error("'" + std::string(word) + "' is not the length of a list");
        more = *length;
      } else if (entry.role >= 0) {
        double& value = row[static_cast<std::size_t>(entry.role)];
        if (!parse_value(word, value)) {
          return error("'" + std::string(word.substr(0, 40)) + "' is not a number (field " +
                       std::string(role_name(static_cast<Role>(entry.role))) + ")");
        }
      }
      if (!skip(more)) {
        return error("ends too early, expected " + std::to_string(more + 1) +
                     " values from value " + std::to_string(column + 1) + " on");
      }
      column += 1 + more;
    }
    return Done{};
  }
};

}  // namespace

Result<std::optional<std::string_view>> LineReader::next() {
  std::size_t searched = 0;
  for (;;) {
    std::string_view rest = input_.rest();
    const std::size_t end = rest.find('\n', searched);
    if (end != std::string_view::npos) {
      std::string_view line = rest.substr(0, end);
      if (line.ends_with('\r')) line.remove_suffix(1);
      input_.consume(end + 1);
      ++number_;
      return std::optional(line);
    }
    searched = rest.size();
    if (searched > kLongestLine) {
      return input_.error(Message("line %1 is longer than a mebibyte; expected text", number_ + 1));
    }
    auto grew = input_.more();
    if (!grew) return grew.error();
    if (*grew) continue;
    rest = input_.rest();
    if (rest.empty()) return std::optional<std::string_view>();
    input_.consume(rest.size());
    ++number_;
    return std::optional(rest);
  }
}

std::string_view next_word(std::string_view& line) {
  const char* at = line.data();
  const char* end = at + line.size();
  while (at != end && is_blank(*at)) ++at;
  const char* start = at;
  while (at != end && !is_blank(*at)) ++at;
  line = {at, static_cast<std::size_t>(end - at)};
  return {start, static_cast<std::size_t>(at - start)};
}

std::optional<std::uint64_t> parse_count(std::string_view word) {
  std::uint64_t value = 0;
  const char* end = word.data() + word.size();
  const auto [stop, code] = std::from_chars(word.data(), end, value);
  if (code != std::errc{} || stop != end) return std::nullopt;
  return value;
}

BlockLayout text_layout(const std::vector<TextEntry>& entries) {
  BlockLayout layout;
  for (const TextEntry& entry : entries) {
    if (entry.role < 0) continue;
    const auto role = static_cast<std::size_t>(entry.role);
    layout.fields[role] = FieldLayout{ScalarType::kF64, role * sizeof(double), sizeof(Row)};
  }
  return layout;
}

Status read_text_rows(Input& input, LineReader& lines, const std::vector<TextEntry>& entries,
                      std::uint64_t points, CloudBuilder& builder) {
  std::vector<Row> rows;
  rows.reserve(kRowsPerBlock);
  const auto flush = [&] {
    builder.append(reinterpret_cast<const char*>(rows.data()), rows.size());
    rows.clear();
  };
  while (builder.seen() + rows.size() < points) {
    auto line = lines.next();
    if (!line) return line.error();
    if (!line->has_value()) break;
    std::string_view words = **line;
    if (words.find_first_not_of(" \t\r\v\f") == std::string_view::npos || words.front() == '#') {
      continue;
    }
    RowParser parser{input, lines.number(), words};
    Row row = {};
    if (Status status = parser.parse(entries, row); !status) {
      // A last line that is cut off in the middle is a truncated file, not a bad line.
      const std::uint64_t found = builder.seen() + rows.size();
      if (input.remaining() == 0 && parser.line.empty()) return truncated(input, points, found);
      return status;
    }
    rows.push_back(row);
    if (rows.size() == kRowsPerBlock) flush();
  }
  flush();
  return Done{};
}

Error truncated(const Input& input, std::uint64_t expected_points, std::uint64_t found_points) {
  return input.error(
      Message("is truncated: its header says %1 points, found %2", expected_points, found_points),
      Message("copy or export the file again"));
}

}  // namespace lvcalib
