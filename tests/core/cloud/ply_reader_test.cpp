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
using testing::ElementsAre;
using testing::HasSubstr;

// A mesh with faces first, then vertices of mixed types with a list among them, then edges.
std::string tricky_header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\nelement nothing 1000000000000\nelement face 2\nproperty list uchar int corners\n"
         "property uchar flag\nelement solid 1\nproperty double a\nproperty short b\n"
         "element vertex 2\nproperty double x\nproperty float y\nproperty list ushort float extra\n"
         "property float z\nproperty uchar scalar_Intensity\nproperty float scalar_Ring\n"
         "element edge 1\nproperty int from\nend_header\n";
}

std::string tricky_body(bool reversed) {
  const auto b = [reversed](auto value) { return bytes(value, reversed); };
  std::string body;
  body += b(std::uint8_t{3}) + b(std::int32_t{0}) + b(std::int32_t{1}) + b(std::int32_t{2}) + "f";
  body += b(std::uint8_t{0}) + std::string("f");
  body += b(1.0) + b(std::int16_t{2});
  body += b(1.5) + b(2.0F) + b(std::uint16_t{2}) + b(9.0F) + b(9.0F) + b(3.0F) +
          b(std::uint8_t{200}) + b(7.0F);
  body += b(-1.5) + b(-2.0F) + b(std::uint16_t{0}) + b(-3.0F) + b(std::uint8_t{100}) + b(8.0F);
  return body + b(std::int32_t{5});
}

void expect_tricky(const Result<Cloud>& cloud) {
  ASSERT_TRUE(cloud.ok()) << cloud.error().text();
  ASSERT_EQ(cloud->size(), 2U);
  EXPECT_EQ(cloud->points_m[0], Eigen::Vector3f(1.5F, 2, 3));
  EXPECT_EQ(cloud->points_m[1], Eigen::Vector3f(-1.5F, -2, -3));
  EXPECT_THAT(cloud->intensity, ElementsAre(200, 100));
  EXPECT_THAT(cloud->line, ElementsAre(7, 8));
  EXPECT_FALSE(cloud->has_time());
}

TEST(PlyReader, DataBehindTheLastPointAreToldOfUnlessTheyAreOtherElements) {
  const std::string points =
      "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 1\nproperty int from\n";
  const std::string point = bytes(1.0F) + bytes(2.0F) + bytes(3.0F);
  const auto warnings = [](const std::string& format, const std::string& rest) {
    const auto cloud = read_cloud_from_memory("ply\nformat " + format + " 1.0\n" + rest, "m");
    EXPECT_TRUE(cloud.ok()) << cloud.error().text();
    return cloud.ok() ? cloud->warnings : std::vector<Message>();
  };
  const std::string binary = "binary_little_endian";
  EXPECT_THAT(warnings(binary, points + "end_header\n" + point + std::string(99, '\0')),
              testing::IsEmpty());
  EXPECT_THAT(warnings(binary, points + faces + "end_header\n" + point + bytes(7)),
              testing::IsEmpty());
  for (const auto& found : {warnings(binary, points + "end_header\n" + point + point),
                            warnings("ascii", points + "end_header\n1 2 3\n4 5 6789012\n")}) {
    ASSERT_EQ(found.size(), 1U);
    EXPECT_THAT(found[0].text(), HasSubstr("12 bytes follow the last of the 1 points"));
  }
}

TEST(PlyReader, TheSameCloudFromAllFormats) {
  expect_tricky(read_cloud_from_memory(
      tricky_header("ascii") +
          "3 0 1 2 1\n0 1\n1.0 2\n1.5 2 2 9 9 3 200 7\n-1.5 -2 0 -3 100 8\n5\n",
      "m"));
  const std::string little = tricky_header("binary_little_endian") + tricky_body(false);
  const std::string big = tricky_header("binary_big_endian") + tricky_body(true);
  for (const std::string& content : {little, big}) {
    expect_tricky(read_cloud_from_memory(content, "m"));
    for (const std::size_t chunk : {1U, 5U, 64U}) {
      Input input = Input::from_memory(content, "m", chunk);
      expect_tricky(read_ply(input));
    }
  }
}

TEST(PlyReader, BigEndianWithoutLists) {
  const std::string text =
      "ply\nformat binary_big_endian 1.0\nelement vertex 2\nproperty float32 x\nproperty float32 "
      "y\nproperty float32 z\nproperty uint t\nend_header\n" +
      bytes(1.0F, true) + bytes(2.0F, true) + bytes(3.0F, true) +
      bytes(std::uint32_t{50'000'000}, true) + bytes(4.0F, true) + bytes(5.0F, true) +
      bytes(6.0F, true) + bytes(std::uint32_t{0}, true);
  const auto cloud = read_cloud_from_memory(text, "m");
  ASSERT_TRUE(cloud.ok()) << cloud.error().text();
  EXPECT_EQ(cloud->points_m[1], Eigen::Vector3f(4, 5, 6));
  EXPECT_THAT(cloud->time_s, ElementsAre(0.05F, 0.0F));
}

TEST(PlyReader, TruncationAtEveryByteIsAnError) {
  const std::string content = tricky_header("binary_little_endian") + tricky_body(false);
  const std::size_t vertices_end = content.size() - 4;  // edges are never read
  for (std::size_t size = 0; size < vertices_end; ++size) {
    ASSERT_FALSE(read_cloud_from_memory(content.substr(0, size), "cut.ply").ok()) << size;
  }
  const auto cut = read_cloud_from_memory(content.substr(0, vertices_end - 1), "cut.ply");
  EXPECT_THAT(cut.error().text(),
              testing::AllOf(HasSubstr("cut.ply"), HasSubstr("2 points"), HasSubstr("found 1")));
}

TEST(PlyReader, HugeClaimsAndBadListsAreRefused) {
  const std::string start = "ply\nformat binary_little_endian 1.0\n";
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const auto text = [&](const std::string& content) {
    const auto cloud = read_cloud_from_memory(content, "m");
    EXPECT_FALSE(cloud.ok());
    return cloud.ok() ? "" : cloud.error().text();
  };
  EXPECT_THAT(
      text(start + "element vertex 100000000\n" + xyz + "end_header\n" + std::string(120, 'a')),
      testing::AllOf(HasSubstr("100000000 points"), HasSubstr("found 10")));
  EXPECT_THAT(text(start + "element face 1\nproperty list int int v\nelement vertex 1\n" + xyz +
                   "end_header\n" + bytes(std::int32_t{-1}) + std::string(99, 'a')),
              HasSubstr("impossible length"));
  EXPECT_THAT(text(start + "element face 1\nproperty list int64 double v\nelement vertex 1\n" +
                   xyz + "end_header\n" + bytes(std::int64_t{1} << 39) + std::string(99, 'a')),
              HasSubstr("ends in element 'face'"));
  EXPECT_THAT(text(start + "element big 1000000000000\nproperty double v\nelement vertex 1\n" +
                   xyz + "end_header\n" + std::string(99, 'a')),
              HasSubstr("ends in element 'big'"));
  EXPECT_THAT(text(start + "element vertex 1\nproperty list uchar float x\n" + xyz.substr(17) +
                   "end_header\n" + std::string(99, 'a')),
              HasSubstr("no field 'x'"));
}

}  // namespace
}  // namespace lvcalib
