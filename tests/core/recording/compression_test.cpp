// SPDX-License-Identifier: GPL-3.0-or-later
#include "recording/compression.h"

#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "support/bag_writer.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

std::string some_bytes(std::size_t count) {
  std::string out;
  std::uint32_t state = 1;
  while (out.size() < count) {
    state = state * 1664525 + 1013904223;
    out += static_cast<char>('a' + (state >> 28U));
  }
  return out;
}

struct Kind {
  test::Packing packing;
  Compression compression;
};
constexpr Kind kKinds[] = {{test::Packing::kNone, Compression::kNone},
                           {test::Packing::kBz2, Compression::kBz2},
                           {test::Packing::kLz4, Compression::kLz4},
                           {test::Packing::kZstd, Compression::kZstd}};

TEST(Compression, UnpacksWhatWasPacked) {
  const std::string plain = some_bytes(3'000'000);
  std::string out = "something before";
  for (const Kind& kind : kKinds) {
    EXPECT_TRUE(decompress(kind.compression, test::pack(kind.packing, plain), plain.size(), out));
    EXPECT_EQ(out == plain, true);
  }
}

TEST(Compression, CutOffGivesTheBeginning) {
  const std::string plain = some_bytes(3'000'000);
  std::string out;
  for (const Kind& kind : kKinds) {
    const std::string packed = test::pack(kind.packing, plain);
    if (kind.compression == Compression::kNone) continue;
    EXPECT_FALSE(decompress(kind.compression, packed.substr(0, packed.size() / 2), 1U << 30U, out));
    EXPECT_GT(out.size(), plain.size() / 4);
    EXPECT_TRUE(plain.starts_with(out));
    EXPECT_FALSE(decompress(kind.compression, "not packed at all", 1U << 30U, out));
  }
}

TEST(Compression, NeverMoreThanTheLimit) {
  const std::string plain(50'000'000, '\0');
  std::string out;
  for (const Kind& kind : kKinds) {
    const std::string packed = test::pack(kind.packing, plain);
    EXPECT_FALSE(decompress(kind.compression, packed, 1'000'000, out));
    EXPECT_LE(out.size(), 1'000'000U);
    EXPECT_LT(out.capacity(), 60'000'000U);
  }
}

TEST(Compression, Names) {
  EXPECT_EQ(compression_by_name(""), Compression::kNone);
  EXPECT_EQ(compression_by_name("lz4"), Compression::kLz4);
  EXPECT_FALSE(compression_by_name("rar").has_value());
  EXPECT_EQ(compression_by_content(test::pack(test::Packing::kZstd, "x")), Compression::kZstd);
  EXPECT_EQ(compression_by_content(test::pack(test::Packing::kLz4, "x")), Compression::kLz4);
  EXPECT_EQ(compression_by_content("\x28"), Compression::kNone);
}

TEST(Compression, Files) {
  const test::TemporaryFolder folder;
  const std::string plain = some_bytes(5'000'000);
  for (const test::Packing packing : {test::Packing::kLz4, test::Packing::kZstd}) {
    const std::string packed = test::pack(packing, plain);
    const auto from = folder.write("packed", packed);
    const auto whole = decompress_file(from, folder.path() / "plain", {});
    ASSERT_TRUE(whole.ok()) << whole.error().text();
    EXPECT_TRUE(*whole);
    std::ifstream in(folder.path() / "plain", std::ios::binary);
    const std::string got((std::istreambuf_iterator<char>(in)), {});
    EXPECT_EQ(got == plain, true);
    const auto half = folder.write("half", packed.substr(0, packed.size() / 2));
    const auto part = decompress_file(half, folder.path() / "plain", {});
    ASSERT_TRUE(part.ok());
    EXPECT_FALSE(*part);
  }
  EXPECT_FALSE(decompress_file(folder.write("text", "hello"), folder.path() / "plain", {}).ok());
}

}  // namespace
}  // namespace lvcalib
