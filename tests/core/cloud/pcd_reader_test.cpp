// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cloud/cloud.h"
#include "cloud/readers.h"
#include "core/cloud/cloud_text.h"

namespace lvcalib {
namespace {

using test::bytes;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

Cloud read_ok(const std::string& content) {
  auto cloud = read_cloud_from_memory(content, "m.pcd");
  EXPECT_TRUE(cloud.ok()) << cloud.error().text();
  return cloud.ok() ? *cloud : Cloud{};
}

std::string message(const std::string& content) {
  const auto cloud = read_cloud_from_memory(content, "m.pcd");
  EXPECT_FALSE(cloud.ok());
  return cloud.ok() ? "" : cloud.error().text();
}

// LZF with literal runs only: what any decompressor must take.
std::string lzf_literals(const std::string& plain) {
  std::string packed;
  for (std::size_t at = 0; at < plain.size(); at += 32) {
    const std::string run = plain.substr(at, 32);
    packed += static_cast<char>(run.size() - 1) + run;
  }
  return packed;
}

std::string compressed_block(const std::string& plain) {
  const std::string packed = lzf_literals(plain);
  return bytes(static_cast<std::uint32_t>(packed.size())) +
         bytes(static_cast<std::uint32_t>(plain.size())) + packed;
}

TEST(PcdReader, AsciiWithMultiValueFieldsInAnyOrder) {
  const std::string text = test::pcd_header("ring normal z y x intensity", "2 4 4 4 4 1",
                                            "U F F F F U", "1 3 1 1 1 1", 2, "ascii") +
                           "5 0 0 1 3 2 1 200\n63 nan 0 1 -3 -2 -1 0\n";
  const Cloud cloud = read_ok(text);
  ASSERT_EQ(cloud.size(), 2U);
  EXPECT_EQ(cloud.points_m[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(cloud.points_m[1], Eigen::Vector3f(-1, -2, -3));
  EXPECT_THAT(cloud.intensity, ElementsAre(200, 0));
  EXPECT_THAT(cloud.line, ElementsAre(5, 63));
}

TEST(PcdReader, BinaryWithPaddingAndMixedTypes) {
  std::string text = test::pcd_header("x _ y z intensity t ring _", "8 1 4 4 1 4 4 2",
                                      "F U F F U U I U", "1 3 1 1 1 1 1 2", 2, "binary");
  text += bytes(1.5) + "pad" + bytes(2.0F) + bytes(3.0F) + bytes<std::uint8_t>(255) +
          bytes<std::uint32_t>(1'000'000) + bytes<std::int32_t>(9) + "PADD";
  text += bytes(-1.5) + "pad" + bytes(-2.0F) + bytes(-3.0F) + bytes<std::uint8_t>(7) +
          bytes<std::uint32_t>(101'000'000) + bytes<std::int32_t>(-9) + "PADD";
  const Cloud cloud = read_ok(text);
  ASSERT_EQ(cloud.size(), 2U);
  EXPECT_EQ(cloud.points_m[0], Eigen::Vector3f(1.5F, 2, 3));
  EXPECT_EQ(cloud.points_m[1], Eigen::Vector3f(-1.5F, -2, -3));
  EXPECT_THAT(cloud.intensity, ElementsAre(255, 7));
  EXPECT_THAT(cloud.time_s, ElementsAre(0.0F, 0.1F));  // nanoseconds
  EXPECT_THAT(cloud.line, ElementsAre(9, 0));
}

TEST(PcdReader, CompressedColumnByColumnWithAndWithoutStoredPadding) {
  const std::string header = test::pcd_header("x _ y z intensity", "4 1 4 4 2", "F U F F U",
                                              "1 4 1 1 1", 2, "binary_compressed");
  const std::string x = bytes(1.0F) + bytes(-1.0F);
  const std::string rest = bytes(2.0F) + bytes(-2.0F) + bytes(3.0F) + bytes(-3.0F) +
                           bytes<std::uint16_t>(500) + bytes<std::uint16_t>(600);
  for (const std::string& plain : {x + "paddingX" + rest, x + rest}) {
    const Cloud cloud = read_ok(header + compressed_block(plain));
    ASSERT_EQ(cloud.size(), 2U);
    EXPECT_EQ(cloud.points_m[0], Eigen::Vector3f(1, 2, 3));
    EXPECT_EQ(cloud.points_m[1], Eigen::Vector3f(-1, -2, -3));
    EXPECT_THAT(cloud.intensity, ElementsAre(500, 600));
  }
}

TEST(PcdReader, CompressedDataThatDoNotFitAreRefused) {
  const std::string header =
      test::pcd_header("x y z", "4 4 4", "F F F", "1 1 1", 2, "binary_compressed");
  const std::string plain(24, 'a');
  const std::string block = compressed_block(plain);
  EXPECT_THAT(message(header + compressed_block(plain + "x")), HasSubstr("hold 25 bytes"));
  EXPECT_THAT(message(header + block.substr(0, 5)), HasSubstr("found 0"));
  EXPECT_THAT(message(header + block.substr(0, 20)), HasSubstr("truncated"));
  std::string damaged = block;
  damaged[8] = static_cast<char>(0xff);  // a reference to before the start
  EXPECT_THAT(message(header + damaged), HasSubstr("damaged"));
  // 24 GB claimed by 4 bytes of data.
  const std::string bomb =
      test::pcd_header("x y z", "4 4 4", "F F F", "1 1 1", 300'000'000, "binary_compressed") +
      bytes<std::uint32_t>(4) + bytes<std::uint32_t>(3'600'000'000U) + "abcd";
  EXPECT_THAT(message(bomb), HasSubstr("too few"));
}

TEST(PcdReader, HugeClaimsCostNoMemory) {
  const std::string point = bytes(1.0F) + bytes(2.0F) + bytes(3.0F) + bytes(4.0F);
  const std::string binary =
      test::pcd_header("x y z intensity", "4 4 4 4", "F F F F", "1 1 1 1", 100'000'000, "binary") +
      point + point + "xy";
  EXPECT_THAT(message(binary), testing::AllOf(HasSubstr("m.pcd"), HasSubstr("100000000 points"),
                                              HasSubstr("found 2")));
  EXPECT_THAT(message(test::ascii_header(1'000'000'000'000) + "1 2 3 4\n"),
              testing::AllOf(HasSubstr("1000000000000 points"), HasSubstr("found 1")));
}

TEST(PcdReader, TrailingBytesAreIgnored) {
  const std::string text = test::pcd_header("x y z", "4 4 4", "F F F", "1 1 1", 1, "binary") +
                           bytes(1.0F) + bytes(2.0F) + bytes(3.0F) + std::string(4096, '\0');
  EXPECT_EQ(read_ok(text).size(), 1U);
  EXPECT_TRUE(read_ok(text).warnings.empty()) << "padding";
}

TEST(PcdReader, DataBehindTheLastPointAreToldOf) {
  const std::string point = bytes(1.0F) + bytes(2.0F) + bytes(3.0F);
  const auto header = [](const char* data) {
    return test::pcd_header("x y z", "4 4 4", "F F F", "1 1 1", 1, data);
  };
  for (const std::string& text : {header("binary") + point + point,
                                  header("binary_compressed") + compressed_block(point) + point,
                                  header("ascii") + "1 2 3\n\n4 5 678901\n"}) {
    const Cloud cloud = read_ok(text);
    EXPECT_EQ(cloud.size(), 1U);
    ASSERT_EQ(cloud.warnings.size(), 1U);
    EXPECT_THAT(cloud.warnings[0].text(), HasSubstr("12 bytes follow the last of the 1 points"));
  }
  EXPECT_TRUE(read_ok(header("ascii") + "1 2 3\n \r\n").warnings.empty());
  EXPECT_TRUE(read_ok(header("binary_compressed") + compressed_block(point)).warnings.empty());
}

TEST(PcdReader, ACompressedCloudUnpacksToTheLimitAndNotBeyond) {
  constexpr std::size_t kPoints = 200'000;
  std::string plain;
  while (plain.size() < 12 * kPoints) plain += bytes(1.0F);
  const std::string text =
      test::pcd_header("x y z", "4 4 4", "F F F", "1 1 1", kPoints, "binary_compressed") +
      compressed_block(plain);
  const auto read = [&](std::uint64_t limit) {
    return read_cloud_from_memory(text, "m.pcd", PointChoice::kReturns, limit);
  };
  EXPECT_TRUE(read(plain.size()).ok());
  const auto refused = read(std::uint64_t{2} << 20U);
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().text(),
              AllOf(HasSubstr("unpack to 3 MiB, more than the limit of 2 MiB"),
                    HasSubstr("clouds.max_unpacked_mib")));
}

TEST(PcdReader, NeededFieldOfUnknownTypeIsRefusedAndOtherFieldsAreNot) {
  EXPECT_THAT(
      message(test::pcd_header("x y z", "4 4 2", "F F F", "1 1 1", 1, "binary") + "abcdefghij"),
      HasSubstr("field 'z' has TYPE F and SIZE 2"));
  EXPECT_EQ(read_ok(test::pcd_header("x y z half", "4 4 4 2", "F F F F", "1 1 1 1", 1, "binary") +
                    bytes(1.0F) + bytes(2.0F) + bytes(3.0F) + "hh")
                .size(),
            1U);
}

// A point larger than the chunk, a chunk that cuts points anywhere: the same cloud.
TEST(PcdReader, ChunksMayCutAnywhere) {
  std::string binary =
      test::pcd_header("x y z intensity", "4 4 4 4", "F F F F", "1 1 1 1", 50, "binary");
  std::string ascii = test::ascii_header(50);
  for (int i = 1; i <= 50; ++i) {
    const auto v = static_cast<float>(i);
    binary += bytes(v) + bytes(2 * v) + bytes(3 * v) + bytes(-v);
    ascii += std::to_string(i) + " " + std::to_string(2 * i) + " " + std::to_string(3 * i) + " -" +
             std::to_string(i) + "\r\n";
  }
  for (const std::string& content : {binary, ascii}) {
    for (const std::size_t chunk : {1U, 7U, 16U, 63U, 300U}) {
      Input input = Input::from_memory(content, "m", chunk);
      const auto cloud = read_pcd(input);
      ASSERT_TRUE(cloud.ok()) << chunk << cloud.error().text();
      ASSERT_EQ(cloud->size(), 50U);
      for (int i = 1; i <= 50; ++i) {
        const auto v = static_cast<float>(i);
        const auto k = static_cast<std::size_t>(i - 1);
        EXPECT_EQ(cloud->points_m[k], Eigen::Vector3f(v, 2 * v, 3 * v));
        EXPECT_EQ(cloud->intensity[k], -v);
      }
    }
  }
}

// Cut at every byte, no file may crash; one that is cut inside its points may not be accepted.
TEST(PcdReader, TruncationAtEveryByteIsAnError) {
  const std::string point = bytes(1.0F) + bytes(2.0F) + bytes(3.0F);
  const std::string binary =
      test::pcd_header("x y z", "4 4 4", "F F F", "1 1 1", 3, "binary") + point + point + point;
  const std::string compressed =
      test::pcd_header("x y z", "4 4 4", "F F F", "1 1 1", 3, "binary_compressed") +
      compressed_block(point + point + point);
  const std::string ascii = test::ascii_header(3) + "1 2 3 4\n5 6 7 8\n9 10 11 12";
  for (const std::string& content : {binary, compressed, ascii}) {
    ASSERT_EQ(read_ok(content).size(), 3U);
    for (std::size_t size = 0; size < content.size(); ++size) {
      // The very last digit of a text cannot be missed.
      if (content == ascii && size + 1 == content.size()) continue;
      const auto cloud = read_cloud_from_memory(content.substr(0, size), "cut.pcd");
      ASSERT_FALSE(cloud.ok()) << size;
      EXPECT_EQ(cloud.error().kind, ErrorKind::kInput);
      EXPECT_EQ(cloud.error().where, "cut.pcd");
    }
  }
}

}  // namespace
}  // namespace lvcalib
