// SPDX-License-Identifier: GPL-3.0-or-later
#include "recording/byte_reader.h"

#include <string>

#include <gtest/gtest.h>

namespace lvcalib {
namespace {

using namespace std::string_literals;

TEST(ByteReader, NumbersOfBothByteOrders) {
  const std::string bytes = "\x01\x02\x03\x04"s;
  EXPECT_EQ(ByteReader(bytes).number<std::uint32_t>(), 0x04030201U);
  EXPECT_EQ(ByteReader(bytes, true).number<std::uint32_t>(), 0x01020304U);
  ByteReader packed(bytes);
  EXPECT_EQ(packed.number<std::uint8_t>(), 1);
  EXPECT_EQ(packed.number<std::uint16_t>(), 0x0302);
  EXPECT_EQ(packed.left(), 1U);
}

TEST(ByteReader, AlignsFromItsOrigin) {
  const std::string bytes = "head\x01\0\0\0\x02\0\0\0\x03\0\0\0\0\0\0\0"s;
  ByteReader reader(bytes);
  reader.take(4);
  reader.align_from_here(8);
  EXPECT_EQ(reader.number<std::uint8_t>(), 1);
  EXPECT_EQ(reader.number<std::uint32_t>(), 2U);
  EXPECT_EQ(reader.number<std::uint64_t>(), 3U);
  EXPECT_FALSE(reader.failed());
  ByteReader narrow(bytes);
  narrow.take(4);
  narrow.align_from_here(4);
  EXPECT_EQ(narrow.number<std::uint32_t>(), 1U);
  EXPECT_EQ(narrow.number<std::uint64_t>(), 2U + (std::uint64_t{3} << 32U));
}

TEST(ByteReader, StaysFailedBeyondTheEnd) {
  const std::string short_block = "\x05\0\0\0abc"s;
  ByteReader reader(short_block);
  EXPECT_EQ(reader.block(), "");
  EXPECT_TRUE(reader.failed());
  EXPECT_EQ(reader.left(), 0U);
  EXPECT_EQ(reader.number<std::uint8_t>(), 0);
  const std::string huge_block = "\xff\xff\xff\xffx"s;
  ByteReader huge(huge_block);
  EXPECT_EQ(huge.block(), "");
  EXPECT_TRUE(huge.failed());
  const std::string whole_block = "\x03\0\0\0abc"s;
  ByteReader whole(whole_block);
  EXPECT_EQ(whole.block(), "abc");
  EXPECT_FALSE(whole.failed());
}

}  // namespace
}  // namespace lvcalib
