// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/pcd_header.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string_view>

#include "base/yaml_file.h"
#include "cloud/text_rows.h"

namespace lvcalib {
namespace {

// Bounds on what a header may claim, far beyond any real file, so that sizes never overflow.
constexpr std::size_t kMostFields = 4096;
constexpr std::uint64_t kLargestPoint = std::uint64_t{1} << 20;
constexpr std::size_t kLongestPcdHeader = std::size_t{4} << 20;

class PcdHeaderParser {
 public:
  explicit PcdHeaderParser(Input& input) : input_(input), lines_(input) {}

  Result<PcdHeader> parse() {
    const std::uint64_t start = input_.remaining();
    for (;;) {
      auto line = lines_.next();
      if (!line) return line.error();
      if (!line->has_value() || start - input_.remaining() > kLongestPcdHeader) {
        return input_.error(Message("its PCD header ends without a DATA line"));
      }
      std::string_view words = **line;
      const std::string_view key = next_word(words);
      if (key.empty() || key.front() == '#') continue;
      if (Status status = take(key, words); !status) return status.error();
      if (key == "DATA") return complete();
    }
  }

 private:
  Status take(std::string_view key, std::string_view words) {
    if (key == "FIELDS" || key == "COLUMNS") return take_fields(words);
    if (key == "SIZE") return take_numbers(key, words, sizes_);
    if (key == "TYPE") return take_types(words);
    if (key == "COUNT") return take_numbers(key, words, counts_);
    if (key == "WIDTH") return take_number(key, words, width_);
    if (key == "HEIGHT") return take_number(key, words, height_);
    if (key == "POINTS") return take_number(key, words, points_);
    if (key == "DATA") return take_data(words);
    if (key == "VIEWPOINT") return check_viewpoint(words);
    if (key == "VERSION") return Done{};
    return error("unknown entry '" + std::string(key.substr(0, 40)) + "' in the PCD header");
  }

  // Where the sensor was (m), and how it was turned (w x y z). Points of a moved sensor may be in
  // its frame or in that of a map, programs differ; the LiDAR's frame is asked for.
  [[nodiscard]] Status check_viewpoint(std::string_view words) const {
    std::array<double, 7> pose{};
    std::size_t count = 0;
    for (auto word = next_word(words); !word.empty(); word = next_word(words)) {
      double value = 0.0;
      if (count == pose.size() || !parse_number(word, value)) {
        return error("VIEWPOINT must hold seven numbers, x y z and the quaternion w x y z");
      }
      pose[count++] = value;
    }
    if (count != 0 && count != pose.size())
      return error("VIEWPOINT must hold seven numbers, found " + std::to_string(count));
    // What a tenth of a millimetre or of a milliradian is worth matters to nobody.
    constexpr double kNothing = 1e-4;
    const bool moved = std::any_of(pose.begin(), pose.begin() + 3,
                                   [](double v) { return !(std::abs(v) < kNothing); });
    const bool turned = std::any_of(pose.begin() + 4, pose.end(),
                                    [](double v) { return !(std::abs(v) < kNothing); });
    if (!moved && !turned) return Done{};
    return error(
        "VIEWPOINT says that the sensor was moved or turned: are the points in its frame or in "
        "that of a map? Write them in the LiDAR's frame, with VIEWPOINT 0 0 0 1 0 0 0");
  }

  [[nodiscard]] Error error(const std::string& message) const {
    return input_.error(Message("line %1: %2", lines_.number(), message));
  }

  Status take_fields(std::string_view words) {
    header_.fields.clear();
    for (auto word = next_word(words); !word.empty(); word = next_word(words)) {
      if (header_.fields.size() == kMostFields) return error("too many fields");
      header_.fields.push_back({.name = std::string(word)});
    }
    return Done{};
  }

  Status take_types(std::string_view words) {
    types_.clear();
    for (auto word = next_word(words); !word.empty(); word = next_word(words)) {
      types_.push_back(word.size() == 1 ? word.front() : '?');
    }
    return Done{};
  }

  Status take_numbers(std::string_view key, std::string_view words,
                      std::vector<std::uint64_t>& numbers) {
    numbers.clear();
    for (auto word = next_word(words); !word.empty(); word = next_word(words)) {
      const auto number = parse_count(word);
      if (!number || *number == 0 || *number > kLargestPoint) {
        return error(std::string(key) + " '" + std::string(word.substr(0, 40)) +
                     "' is out of range, expected a whole number from 1 to " +
                     std::to_string(kLargestPoint));
      }
      numbers.push_back(*number);
    }
    return Done{};
  }

  Status take_number(std::string_view key, std::string_view words,
                     std::optional<std::uint64_t>& number) {
    const std::string_view word = next_word(words);
    number = parse_count(word);
    // 2⁴⁰ points are more than any disk holds and leave products with a point's size exact.
    if (number && *number <= std::uint64_t{1} << 40) return Done{};
    return error(std::string(key) + " '" + std::string(word.substr(0, 40)) +
                 "' is not a number of points");
  }

  Status take_data(std::string_view words) {
    const std::string_view word = next_word(words);
    if (word == "ascii") {
      header_.data = PcdData::kAscii;
    } else if (word == "binary") {
      header_.data = PcdData::kBinary;
    } else if (word == "binary_compressed") {
      header_.data = PcdData::kBinaryCompressed;
    } else {
      return error("DATA '" + std::string(word.substr(0, 40)) +
                   "' is not known, expected ascii, binary or binary_compressed");
    }
    return Done{};
  }

  Result<PcdHeader> complete() {
    const std::size_t count = header_.fields.size();
    if (counts_.empty()) counts_.assign(count, 1);
    if (count == 0 || sizes_.size() != count || types_.size() != count || counts_.size() != count) {
      return input_.error(
          Message("its PCD header does not agree with itself: %1 FIELDS, %2 SIZE, %3 TYPE, %4 "
                  "COUNT entries",
                  count, sizes_.size(), types_.size(), counts_.size()));
    }
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < count; ++i) {
      PcdField& field = header_.fields[i];
      field.size = static_cast<std::size_t>(sizes_[i]);
      field.type = types_[i];
      field.count = static_cast<std::size_t>(counts_[i]);
      bytes += sizes_[i] * counts_[i];  // at most 4096 · 2⁴⁰
    }
    if (bytes > kLargestPoint) {
      return input_.error(Message("its PCD header claims points of %1 bytes, expected at most %2",
                                  bytes, kLargestPoint));
    }
    return with_points();
  }

  Result<PcdHeader> with_points() {
    std::optional<std::uint64_t> grid;
    if (width_ && height_) {
      if (*height_ > 0 && *width_ > (std::uint64_t{1} << 40) / *height_) {
        return input_.error(Message("its PCD header claims more than 2^40 points"));
      }
      grid = *width_ * *height_;
    }
    if (points_ && grid && *points_ != *grid) {
      return input_.error(
          Message("its PCD header does not agree with itself: POINTS is %1, WIDTH x HEIGHT is %2",
                  *points_, *grid));
    }
    if (!points_ && !grid) {
      return input_.error(
          Message("its PCD header lacks the number of points (POINTS, or WIDTH and HEIGHT)"));
    }
    header_.points = points_ ? *points_ : *grid;
    if (grid && *height_ > 0) header_.rows = *height_;
    header_.line_count = lines_.number();
    return std::move(header_);
  }

  Input& input_;
  LineReader lines_;
  PcdHeader header_;
  std::vector<std::uint64_t> sizes_;
  std::vector<std::uint64_t> counts_;
  std::vector<char> types_;
  std::optional<std::uint64_t> width_;
  std::optional<std::uint64_t> height_;
  std::optional<std::uint64_t> points_;
};

}  // namespace

std::size_t PcdHeader::point_bytes() const {
  return std::accumulate(
      fields.begin(), fields.end(), std::size_t{0},
      [](std::size_t sum, const PcdField& field) { return sum + field.bytes(); });
}

Result<PcdHeader> read_pcd_header(Input& input) {
  return PcdHeaderParser(input).parse();
}

}  // namespace lvcalib
