// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/ply_header.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "cloud/text_rows.h"

namespace lvcalib {
namespace {

// Bounds on what a header may claim, far beyond any real file, so that sizes never overflow.
constexpr std::size_t kMostElements = 256;
constexpr std::size_t kMostProperties = 4096;
constexpr std::uint64_t kMostRows = std::uint64_t{1} << 40;
constexpr std::size_t kLongestPlyHeader = std::size_t{4} << 20;

std::optional<ScalarType> ply_type(std::string_view name) {
  using enum ScalarType;
  constexpr std::pair<std::string_view, ScalarType> kTypes[] = {
      {"char", kI8},     {"int8", kI8},    {"uchar", kU8},   {"uint8", kU8},   {"short", kI16},
      {"int16", kI16},   {"ushort", kU16}, {"uint16", kU16}, {"int", kI32},    {"int32", kI32},
      {"uint", kU32},    {"uint32", kU32}, {"int64", kI64},  {"uint64", kU64}, {"float", kF32},
      {"float32", kF32}, {"double", kF64}, {"float64", kF64}};
  for (const auto& [known, type] : kTypes) {
    if (name == known) return type;
  }
  return std::nullopt;
}

class PlyHeaderParser {
 public:
  explicit PlyHeaderParser(Input& input) : input_(input), lines_(input) {}

  Result<PlyHeader> parse() {
    const std::uint64_t start = input_.remaining();
    for (;;) {
      auto line = lines_.next();
      if (!line) return line.error();
      if (!line->has_value() || start - input_.remaining() > kLongestPlyHeader) {
        return input_.error(Message("its PLY header ends without an end_header line"));
      }
      std::string_view words = **line;
      const std::string_view key = next_word(words);
      if (lines_.number() == 1) {
        if (key != "ply") return error("expected 'ply'");
        continue;
      }
      if (key == "end_header") return complete();
      if (Status status = take(key, words); !status) return status.error();
    }
  }

 private:
  Status take(std::string_view key, std::string_view words) {
    if (key.empty() || key == "comment" || key == "obj_info") return Done{};
    if (key == "format") return take_format(words);
    if (key == "element") return take_element(words);
    if (key == "property") return take_property(words);
    return error("unknown entry '" + std::string(key.substr(0, 40)) + "' in the PLY header");
  }

  [[nodiscard]] Error error(const std::string& message) const {
    return input_.error(Message("line %1: %2", lines_.number(), message));
  }

  Status take_format(std::string_view words) {
    const std::string_view format = next_word(words);
    has_format_ = true;
    if (format == "ascii") {
      header_.format = PlyFormat::kAscii;
    } else if (format == "binary_little_endian") {
      header_.format = PlyFormat::kLittleEndian;
    } else if (format == "binary_big_endian") {
      header_.format = PlyFormat::kBigEndian;
    } else {
      return error("format '" + std::string(format.substr(0, 40)) +
                   "' is not known, expected ascii, binary_little_endian or binary_big_endian");
    }
    return Done{};
  }

  Status take_element(std::string_view words) {
    PlyElement element;
    element.name = next_word(words);
    const std::string_view word = next_word(words);
    const auto count = parse_count(word);
    if (!count || *count > kMostRows) {
      return error("'" + std::string(word.substr(0, 40)) + "' is not a number of elements");
    }
    if (header_.elements.size() == kMostElements) return error("too many elements");
    element.count = *count;
    header_.elements.push_back(std::move(element));
    return Done{};
  }

  Status take_property(std::string_view words) {
    if (header_.elements.empty()) return error("a property before the first element");
    PlyProperty property;
    std::string_view type_name = next_word(words);
    if (type_name == "list") {
      const auto length_type = ply_type(next_word(words));
      if (!length_type || !is_integer(*length_type)) {
        return error("a list needs an integer type for its length");
      }
      property.length_type = length_type;
      type_name = next_word(words);
    }
    const auto type = ply_type(type_name);
    if (!type) return error("unknown type '" + std::string(type_name.substr(0, 40)) + "'");
    property.type = *type;
    property.name = next_word(words);
    if (property.name.empty()) return error("a property without a name");
    auto& properties = header_.elements.back().properties;
    if (properties.size() == kMostProperties) return error("too many properties");
    properties.push_back(std::move(property));
    return Done{};
  }

  Result<PlyHeader> complete() {
    if (!has_format_) return input_.error(Message("its PLY header has no format line"));
    const auto found = std::find_if(header_.elements.begin(), header_.elements.end(),
                                    [](const PlyElement& e) { return e.name == "vertex"; });
    if (found == header_.elements.end()) {
      return input_.error(Message("its PLY header has no element 'vertex'"));
    }
    header_.vertex = static_cast<std::size_t>(found - header_.elements.begin());
    header_.line_count = lines_.number();
    return std::move(header_);
  }

  Input& input_;
  LineReader lines_;
  PlyHeader header_;
  bool has_format_ = false;
};

}  // namespace

bool PlyElement::has_list() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& p) { return p.length_type.has_value(); });
}

std::size_t PlyElement::scalar_bytes() const {
  std::size_t bytes = 0;
  for (const PlyProperty& property : properties) {
    if (!property.length_type) bytes += scalar_size(property.type);
  }
  return bytes;
}

Result<PlyHeader> read_ply_header(Input& input) {
  return PlyHeaderParser(input).parse();
}

}  // namespace lvcalib
