// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include "cloud/ply_header.h"
#include "cloud/readers.h"
#include "cloud/text_rows.h"

namespace lvcalib {
namespace {

// Roles of the vertex element's properties; lists cannot have one.
Result<RoleFields> find_roles(const Input& input, const PlyElement& vertices) {
  std::vector<std::string> names;
  for (const PlyProperty& property : vertices.properties) {
    names.push_back(property.length_type ? std::string() : property.name);
  }
  return assign_roles(names, input.name());
}

int role_of(const RoleFields& roles, std::size_t property) {
  const auto found = std::find(roles.begin(), roles.end(), static_cast<int>(property));
  return found == roles.end() ? -1 : static_cast<int>(found - roles.begin());
}

// Where the roles lie in a row of scalars without its lists.
BlockLayout packed_layout(const PlyElement& vertices, const RoleFields& roles, bool swap_bytes) {
  BlockLayout layout;
  layout.swap_bytes = swap_bytes;
  std::size_t offset = 0;
  for (std::size_t i = 0; i < vertices.properties.size(); ++i) {
    const PlyProperty& property = vertices.properties[i];
    if (property.length_type) continue;
    const int role = role_of(roles, i);
    if (role >= 0) {
      layout.fields[static_cast<std::size_t>(role)] =
          FieldLayout{property.type, offset, vertices.scalar_bytes()};
    }
    offset += scalar_size(property.type);
  }
  return layout;
}

// Walks rows whose length depends on their lists.
class ListRowReader {
 public:
  ListRowReader(Input& input, const PlyElement& element, bool swap_bytes)
      : input_(input), element_(element), swap_bytes_(swap_bytes) {}

  // Passes over one row and appends its scalars to `scalars`, if given. False at the end.
  Result<bool> next(std::vector<char>* scalars) {
    for (const PlyProperty& property : element_.properties) {
      std::uint64_t skip = scalar_size(property.type);
      if (property.length_type) {
        auto length = list_length(property);
        if (!length) return length.error();
        if (*length < 0) return false;
        skip *= static_cast<std::uint64_t>(*length);
      } else if (scalars != nullptr) {
        auto complete = input_.require(static_cast<std::size_t>(skip));
        if (!complete || !*complete) return complete;
        scalars->insert(scalars->end(), input_.rest().begin(),
                        input_.rest().begin() + static_cast<std::ptrdiff_t>(skip));
      }
      auto complete = input_.skip(skip);
      if (!complete || !*complete) return complete;
    }
    return true;
  }

 private:
  // Consumes a list's length; −1 at the end of the file.
  Result<std::int64_t> list_length(const PlyProperty& property) {
    const std::size_t size = scalar_size(*property.length_type);
    auto complete = input_.require(size);
    if (!complete) return complete.error();
    if (!*complete) return std::int64_t{-1};
    const double length = decode_scalar(input_.rest().data(), *property.length_type, swap_bytes_);
    input_.consume(size);
    // No file holds 2⁴⁰ entries, and a product with a scalar's size stays exact.
    if (length < 0 || length > 1099511627776.0) {
      return input_.error(
          Message("a list of property '%1' has an impossible length", property.name));
    }
    return static_cast<std::int64_t>(length);
  }

  Input& input_;
  const PlyElement& element_;
  bool swap_bytes_;
};

Error ends_before_vertices(const Input& input, const PlyElement& element) {
  return input.error(
      Message("is truncated: it ends in element '%1' before any of its points", element.name),
      Message("copy or export the file again"));
}

Status skip_binary_element(Input& input, const PlyElement& element, bool swap_bytes) {
  if (!element.has_list()) {
    const std::uint64_t bytes = element.count * element.scalar_bytes();
    auto complete = input.skip(bytes);
    if (!complete) return complete.error();
    if (!*complete) return ends_before_vertices(input, element);
    return Done{};
  }
  ListRowReader rows(input, element, swap_bytes);
  for (std::uint64_t row = 0; row < element.count; ++row) {
    auto complete = rows.next(nullptr);
    if (!complete) return complete.error();
    if (!*complete) return ends_before_vertices(input, element);
  }
  return Done{};
}

Status read_list_rows(Input& input, const PlyElement& vertices, bool swap_bytes,
                      CloudBuilder& builder) {
  constexpr std::size_t kRowsPerBlock = 1024;
  ListRowReader rows(input, vertices, swap_bytes);
  std::vector<char> block;
  std::size_t in_block = 0;
  const auto flush = [&] {
    builder.append(block.data(), in_block);
    block.clear();
    in_block = 0;
  };
  while (builder.seen() + in_block < vertices.count) {
    auto complete = rows.next(&block);
    if (!complete) return complete.error();
    if (!*complete) return truncated(input, vertices.count, builder.seen() + in_block);
    if (++in_block == kRowsPerBlock) flush();
  }
  flush();
  return Done{};
}

// The cloud, and a look at what follows its points unless other elements do.
Result<Cloud> finish(Input& input, const PlyHeader& header, CloudBuilder& builder) {
  auto cloud = builder.finish(input.name());
  if (!cloud) return cloud;
  const auto after = header.elements.begin() + static_cast<std::ptrdiff_t>(header.vertex) + 1;
  if (std::any_of(after, header.elements.end(), [](const PlyElement& e) { return e.count > 0; }))
    return cloud;
  if (Status s = look_behind_points(input, header.vertices().count, *cloud); !s) return s.error();
  return cloud;
}

Result<Cloud> read_binary(Input& input, const PlyHeader& header, const RoleFields& roles,
                          PointChoice choice) {
  const bool file_is_little = header.format == PlyFormat::kLittleEndian;
  const bool swap_bytes = file_is_little != (std::endian::native == std::endian::little);
  for (std::size_t i = 0; i < header.vertex; ++i) {
    Status status = skip_binary_element(input, header.elements[i], swap_bytes);
    if (!status) return status.error();
  }
  const PlyElement& vertices = header.vertices();
  const bool integer_time =
      roles[kTime] >= 0 &&
      is_integer(vertices.properties[static_cast<std::size_t>(roles[kTime])].type);
  const std::size_t row_bytes = vertices.scalar_bytes();
  CloudBuilder builder(packed_layout(vertices, roles, swap_bytes), integer_time,
                       std::min<std::uint64_t>(vertices.count, input.remaining() / row_bytes),
                       choice);
  const Status status = vertices.has_list()
                            ? read_list_rows(input, vertices, swap_bytes, builder)
                            : read_binary_points(input, row_bytes, vertices.count, builder);
  if (!status) return status.error();
  return finish(input, header, builder);
}

// One row of a text element is one line.
Status skip_text_element(Input& input, LineReader& lines, const PlyElement& element) {
  if (element.properties.empty()) return Done{};
  for (std::uint64_t row = 0; row < element.count;) {
    auto line = lines.next();
    if (!line) return line.error();
    if (!line->has_value()) return ends_before_vertices(input, element);
    std::string_view words = **line;
    if (!next_word(words).empty()) ++row;
  }
  return Done{};
}

Result<Cloud> read_ascii(Input& input, const PlyHeader& header, const RoleFields& roles,
                         PointChoice choice) {
  LineReader lines(input, header.line_count);
  for (std::size_t i = 0; i < header.vertex; ++i) {
    Status status = skip_text_element(input, lines, header.elements[i]);
    if (!status) return status.error();
  }
  const PlyElement& vertices = header.vertices();
  std::vector<TextEntry> entries;
  for (std::size_t i = 0; i < vertices.properties.size(); ++i) {
    entries.push_back({role_of(roles, i), 1, vertices.properties[i].length_type.has_value()});
  }
  const bool integer_time =
      roles[kTime] >= 0 &&
      is_integer(vertices.properties[static_cast<std::size_t>(roles[kTime])].type);
  // A value takes a digit and a separator at least.
  const std::uint64_t possible = input.remaining() / (2 * entries.size()) + 1;
  CloudBuilder builder(text_layout(entries), integer_time, std::min(vertices.count, possible),
                       choice);
  const Status status = read_text_rows(input, lines, entries, vertices.count, builder);
  if (!status) return status.error();
  if (builder.seen() < vertices.count) return truncated(input, vertices.count, builder.seen());
  return finish(input, header, builder);
}

}  // namespace

Result<Cloud> read_ply(Input& input, PointChoice choice) {
  auto header = read_ply_header(input);
  if (!header) return header.error();
  auto roles = find_roles(input, header->vertices());
  if (!roles) return roles.error();
  return header->format == PlyFormat::kAscii ? read_ascii(input, *header, *roles, choice)
                                             : read_binary(input, *header, *roles, choice);
}

}  // namespace lvcalib
