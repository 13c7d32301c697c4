// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "support/bag_writer.h"

namespace lvcalib::test {

/// One way of storing a recording.
struct ContainerCase {
  std::string name;
  enum Kind { kRos1, kMcap, kSqlite, kMcapFolder, kSqliteFolder } kind = kRos1;
  BagFormat format;
  int splits = 1;
};

inline void PrintTo(const ContainerCase& c, std::ostream* out) {
  *out << c.name;
}

/// Every container and compression that is read.
inline std::vector<ContainerCase> all_containers() {
  using C = ContainerCase;
  const auto packed = [](Packing packing) { return BagFormat{.packing = packing}; };
  std::vector<C> out = {
      {"ros1", C::kRos1, {}, 1},
      {"ros1_bz2", C::kRos1, packed(Packing::kBz2), 1},
      {"ros1_lz4", C::kRos1, packed(Packing::kLz4), 1},
      {"ros1_unindexed", C::kRos1, {.index = false}, 1},
      {"ros1_lz4_unindexed", C::kRos1, {.packing = Packing::kLz4, .index = false}, 1},
      {"mcap", C::kMcap, {}, 1},
      {"mcap_lz4", C::kMcap, packed(Packing::kLz4), 1},
      {"mcap_zstd", C::kMcap, packed(Packing::kZstd), 1},
      {"mcap_no_summary", C::kMcap, {.packing = Packing::kZstd, .index = false}, 1},
      {"mcap_no_chunks", C::kMcap, {.chunks = false}, 1},
      {"mcap_no_chunks_no_summary", C::kMcap, {.index = false, .chunks = false}, 1},
      {"sqlite", C::kSqlite, {}, 1},
      {"sqlite_folder", C::kSqliteFolder, {}, 1},
      {"sqlite_split", C::kSqliteFolder, {}, 3},
      {"mcap_split", C::kMcapFolder, packed(Packing::kZstd), 3}};
  for (const Packing packing : {Packing::kZstd, Packing::kLz4}) {
    const std::string name = packing == Packing::kZstd ? "zstd" : "lz4";
    BagFormat files{.packing = packing, .packs_files = true};
    BagFormat messages{.packing = packing, .packs_messages = true};
    out.push_back({"sqlite_files_" + name, C::kSqliteFolder, files, 2});
    out.push_back({"sqlite_messages_" + name, C::kSqliteFolder, messages, 1});
    out.push_back({"mcap_messages_" + name, C::kMcapFolder, messages, 1});
    if (packing == Packing::kZstd) out.push_back({"mcap_files_" + name, C::kMcapFolder, files, 2});
  }
  return out;
}

inline Wire wire_of(const ContainerCase& c) {
  return c.kind == ContainerCase::kRos1 ? Wire::kRos1 : Wire::kCdrLittle;
}

/// Writes the messages into `folder`; the path to open.
inline std::filesystem::path write_recording(const ContainerCase& c,
                                             const std::filesystem::path& folder,
                                             const std::vector<BagMessage>& messages) {
  switch (c.kind) {
    case ContainerCase::kRos1:
      write_bytes(folder / "test.bag", ros1_bag(messages, c.format));
      return folder / "test.bag";
    case ContainerCase::kMcap:
      write_bytes(folder / "test.mcap", mcap_file(messages, c.format));
      return folder / "test.mcap";
    case ContainerCase::kSqlite:
      write_sqlite_bag(folder / "test.db3", messages);
      return folder / "test.db3";
    case ContainerCase::kMcapFolder:
      write_rosbag2(folder / "bag", messages, "mcap", c.splits, c.format);
      return folder / "bag";
    case ContainerCase::kSqliteFolder:
      break;
  }
  write_rosbag2(folder / "bag", messages, "sqlite3", c.splits, c.format);
  return folder / "bag";
}

}  // namespace lvcalib::test
