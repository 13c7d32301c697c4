// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string_view>

#include <lzf.h>

#include "base/text.h"
#include "cloud/pcd_header.h"
#include "cloud/readers.h"
#include "cloud/text_rows.h"

namespace lvcalib {
namespace {

// The scalar type of a field that is needed; an error if there is no such type.
Result<ScalarType> field_type(const Input& input, const PcdField& field) {
  const auto type = pcd_scalar_type(field.type, field.size);
  if (type) return *type;
  return input.error(Message(
      "field '%1' has TYPE %2 and SIZE %3, expected F with 4 or 8 or I or U with 1, 2, 4 or 8",
      field.name, field.type, field.size));
}

struct PcdColumns {
  RoleFields roles = {};
  std::vector<ScalarType> types;  // by role; meaningless for roles without a field
  PointChoice choice = PointChoice::kReturns;
  [[nodiscard]] bool time_is_integer() const {
    return roles[kTime] >= 0 && is_integer(types[kTime]);
  }
};

Result<PcdColumns> find_columns(const Input& input, const PcdHeader& header, PointChoice choice) {
  std::vector<std::string> names;
  for (const PcdField& field : header.fields) names.push_back(field.name);
  auto roles = assign_roles(names, input.name());
  if (!roles) return roles.error();
  PcdColumns columns{*roles, std::vector<ScalarType>(kRoleCount, ScalarType::kF32), choice};
  for (std::size_t role = 0; role < kRoleCount; ++role) {
    if (columns.roles[role] < 0) continue;
    auto type = field_type(input, header.fields[static_cast<std::size_t>(columns.roles[role])]);
    if (!type) return type.error();
    columns.types[role] = *type;
  }
  return columns;
}

Result<Cloud> finish(Input& input, const PcdHeader& header, CloudBuilder& builder) {
  if (builder.seen() < header.points) return truncated(input, header.points, builder.seen());
  auto cloud = builder.finish(input.name(), header.rows);
  if (!cloud) return cloud;
  if (Status s = look_behind_points(input, header.points, *cloud); !s) return s.error();
  return cloud;
}

Result<Cloud> read_ascii(Input& input, const PcdHeader& header, const PcdColumns& columns) {
  std::vector<TextEntry> entries;
  std::uint64_t words = 0;
  for (const PcdField& field : header.fields) {
    entries.push_back({-1, field.count, false});
    words += field.count;
  }
  for (std::size_t role = 0; role < kRoleCount; ++role) {
    if (columns.roles[role] < 0) continue;
    entries[static_cast<std::size_t>(columns.roles[role])].role = static_cast<int>(role);
  }
  // A value takes a digit and a separator at least.
  const std::uint64_t possible = input.remaining() / (2 * words) + 1;
  CloudBuilder builder(text_layout(entries), columns.time_is_integer(),
                       std::min(header.points, possible), columns.choice);
  LineReader lines(input, header.line_count);
  const Status status = read_text_rows(input, lines, entries, header.points, builder);
  if (!status) return status.error();
  return finish(input, header, builder);
}

Result<Cloud> read_binary(Input& input, const PcdHeader& header, const PcdColumns& columns) {
  BlockLayout layout;
  const std::size_t point_bytes = header.point_bytes();
  std::size_t offset = 0;
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    for (std::size_t role = 0; role < kRoleCount; ++role) {
      if (columns.roles[role] != static_cast<int>(i)) continue;
      layout.fields[role] = FieldLayout{columns.types[role], offset, point_bytes};
    }
    offset += header.fields[i].bytes();
  }
  CloudBuilder builder(layout, columns.time_is_integer(),
                       std::min<std::uint64_t>(header.points, input.remaining() / point_bytes),
                       columns.choice);
  const Status status = read_binary_points(input, point_bytes, header.points, builder);
  if (!status) return status.error();
  return finish(input, header, builder);
}

struct Block {
  std::unique_ptr<char[]> bytes;  // not zeroed first: this is the largest buffer of the room
  std::uint32_t size = 0;
};

// The block of compressed data: two 32-bit sizes, then the LZF stream.
Result<Block> decompress(Input& input, std::uint64_t points, std::uint64_t padded,
                         std::uint64_t unpadded, std::uint64_t max_unpacked_bytes) {
  std::uint32_t sizes[2] = {};
  auto complete = input.require(sizeof sizes);
  if (!complete) return complete.error();
  if (!*complete) return truncated(input, points, 0);
  std::memcpy(sizes, input.rest().data(), sizeof sizes);
  input.consume(sizeof sizes);
  const auto [packed, plain] = sizes;
  if (plain != padded && plain != unpadded) {
    return input.error(Message("its compressed data hold %1 bytes, expected %2 for %3 points",
                               plain, padded, points));
  }
  if (packed > input.remaining()) {
    return input.error(Message("is truncated: its compressed data take %1 bytes, found %2, so none "
                               "of %3 points can be read",
                               packed, input.remaining(), points),
                       Message("copy or export the file again"));
  }
  // Three bytes of LZF give at most 264 bytes; this bounds memory by the file's real size.
  if (plain > 88 * static_cast<std::uint64_t>(packed)) {
    return input.error(
        Message("its compressed data cannot hold %1 points: %2 bytes are too few", points, packed));
  }
  if (plain > max_unpacked_bytes) {
    constexpr double kMebibyte = 1024.0 * 1024.0;
    return input.error(
        Message("its compressed data unpack to %1 MiB, more than the limit of %2 MiB",
                formatted("%.0f", std::ceil(plain / kMebibyte)),
                formatted("%.0f", static_cast<double>(max_unpacked_bytes) / kMebibyte)),
        Message("write the cloud with fewer points or uncompressed, or raise "
                "clouds.max_unpacked_mib in the options"));
  }
  complete = input.require(packed);
  if (!complete) return complete.error();
  Block block{std::unique_ptr<char[]>(new char[std::max<std::size_t>(plain, 1)]), plain};
  if (!*complete || (plain > 0 && lzf_decompress(input.rest().data(), packed, block.bytes.get(),
                                                 plain) != plain)) {
    return input.error(Message("its compressed data are damaged"),
                       Message("copy or export the file again"));
  }
  input.consume(packed);
  return block;
}

Result<Cloud> read_compressed(Input& input, const PcdHeader& header, const PcdColumns& columns,
                              std::uint64_t max_unpacked_bytes) {
  std::uint64_t unpadded_bytes = 0;
  for (const PcdField& field : header.fields) {
    if (field.name != "_") unpadded_bytes += field.bytes();
  }
  const std::uint64_t padded = header.points * header.point_bytes();
  auto block =
      decompress(input, header.points, padded, header.points * unpadded_bytes, max_unpacked_bytes);
  if (!block) return block.error();

  // Column by column; some writers leave the padding out.
  BlockLayout layout;
  std::size_t offset = 0;
  const auto points = static_cast<std::size_t>(header.points);
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    const PcdField& field = header.fields[i];
    if (field.name == "_" && block->size != padded) continue;
    for (std::size_t role = 0; role < kRoleCount; ++role) {
      if (columns.roles[role] != static_cast<int>(i)) continue;
      layout.fields[role] = FieldLayout{columns.types[role], offset, field.bytes()};
    }
    offset += points * field.bytes();
  }
  CloudBuilder builder(layout, columns.time_is_integer(), header.points, columns.choice);
  builder.append(block->bytes.get(), points);
  return finish(input, header, builder);
}

}  // namespace

Status look_behind_points(Input& input, std::uint64_t points, Cloud& cloud) {
  constexpr std::string_view kPadding("\0 \t\r\n\v\f", 7);
  // Padding fills a block of a disk or a page of memory; what begins later follows from nothing
  // that wrote points.
  constexpr std::uint64_t kFarthest = Input::kDefaultChunk;
  const std::uint64_t bytes = input.remaining();
  for (std::uint64_t looked = 0; looked < kFarthest;) {
    const std::string_view rest = input.rest();
    if (rest.find_first_not_of(kPadding) != std::string_view::npos) {
      cloud.warnings.push_back(
          Message("%1 bytes follow the last of the %2 points that its header counts, and are left "
                  "out: are there more points, or two files in one?",
                  bytes, points));
      return Done{};
    }
    looked += rest.size();
    input.consume(rest.size());
    auto grew = input.more();
    if (!grew) return grew.error();
    if (!*grew) break;
  }
  return Done{};
}

Status read_binary_points(Input& input, std::size_t point_bytes, std::uint64_t points,
                          CloudBuilder& builder) {
  while (builder.seen() < points) {
    const std::uint64_t available = input.rest().size() / point_bytes;
    const std::uint64_t count = std::min(available, points - builder.seen());
    builder.append(input.rest().data(), static_cast<std::size_t>(count));
    input.consume(static_cast<std::size_t>(count) * point_bytes);
    if (builder.seen() == points) break;
    auto grew = input.more();
    if (!grew) return grew.error();
    if (!*grew) return truncated(input, points, builder.seen());
  }
  return Done{};
}

Result<Cloud> read_pcd(Input& input, PointChoice choice, std::uint64_t max_unpacked_bytes) {
  auto header = read_pcd_header(input);
  if (!header) return header.error();
  auto columns = find_columns(input, *header, choice);
  if (!columns) return columns.error();
  switch (header->data) {
    case PcdData::kAscii:
      return read_ascii(input, *header, *columns);
    case PcdData::kBinary:
      return read_binary(input, *header, *columns);
    case PcdData::kBinaryCompressed:
      break;
  }
  return read_compressed(input, *header, *columns, max_unpacked_bytes);
}

}  // namespace lvcalib
