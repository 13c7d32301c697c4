// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud/pcd_header.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lvcalib {
namespace {

using testing::HasSubstr;

Result<PcdHeader> parse(const std::string& text) {
  Input input = Input::from_memory(text, "h.pcd");
  return read_pcd_header(input);
}

TEST(PcdHeader, ReadsFieldsWithCountsAndPadding) {
  const auto header = parse(
      "# comment\r\nVERSION .7\r\n\r\nFIELDS x y z _ i\r\nSIZE 4 4 8 1 2\r\nTYPE F F F U I\r\n"
      "COUNT 1 1 1 5 2\r\n# another\r\nWIDTH 4\r\nHEIGHT 3\r\nDATA binary\r\nrest");
  ASSERT_TRUE(header.ok()) << header.error().text();
  EXPECT_EQ(header->points, 12U);
  EXPECT_EQ(header->point_bytes(), 4U + 4 + 8 + 5 + 4);
  EXPECT_EQ(header->data, PcdData::kBinary);
  ASSERT_EQ(header->fields.size(), 5U);
  EXPECT_EQ(header->fields[4].name, "i");
  EXPECT_EQ(header->fields[4].type, 'I');
  EXPECT_EQ(header->line_count, 11U);
}

TEST(PcdHeader, CountAndEitherNumberOfPointsMayBeMissing) {
  const std::string start = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n";
  EXPECT_EQ(parse(start + "POINTS 7\nDATA ascii\n")->points, 7U);
  EXPECT_EQ(parse(start + "WIDTH 2\nHEIGHT 3\nDATA ascii\n")->points, 6U);
  EXPECT_EQ(parse(start + "WIDTH 7\nPOINTS 7\nDATA ascii\n")->points, 7U);
}

// Programs differ on whether points of a moved sensor are in its frame or in that of a map.
TEST(PcdHeader, RefusesAViewpointThatIsNotTheOrigin) {
  const auto with = [](const std::string& viewpoint) {
    return parse("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nVIEWPOINT" + viewpoint +
                 "\nPOINTS 7\nDATA ascii\n");
  };
  for (const char* origin :
       {"", " 0 0 0 1 0 0 0", " 0 0 0 -1 0 0 0", " 0.0 -0 1e-9 1.0 0 0 0", " 0 0 0 0 0 0 0"}) {
    EXPECT_TRUE(with(origin).ok()) << origin;
  }
  for (const char* moved :
       {" 1 0 0 1 0 0 0", " 0 0 -0.01 1 0 0 0", " 0 0 0 0.9 0 0 0.4359", " nan 0 0 1 0 0 0"}) {
    const auto header = with(moved);
    ASSERT_FALSE(header.ok()) << moved;
    EXPECT_EQ(header.error().kind, ErrorKind::kInput);
    EXPECT_THAT(header.error().text(), HasSubstr("line 4: VIEWPOINT")) << moved;
  }
  EXPECT_THAT(with(" 0 0 0").error().text(), HasSubstr("found 3"));
  EXPECT_THAT(with(" 0 0 0 1 0 0 0 0").error().text(), HasSubstr("seven numbers"));
  EXPECT_THAT(with(" here 0 0 1 0 0 0").error().text(), HasSubstr("seven numbers"));
}

TEST(PcdHeader, RefusesWhatDoesNotAgree) {
  const std::string good = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n";
  const struct {
    std::string text, expected;
  } cases[] = {
      {good + "POINTS 7\n", "without a DATA line"},
      {good + "DATA ascii\n", "lacks the number of points"},
      {good + "WIDTH 7\nDATA ascii\n", "lacks the number of points"},
      {good + "WIDTH 2\nHEIGHT 2\nPOINTS 5\nDATA ascii\n", "WIDTH x HEIGHT is 4"},
      {good + "POINTS -1\nDATA ascii\n", "line 4: POINTS '-1'"},
      {good + "POINTS 1e8\nDATA ascii\n", "POINTS '1e8'"},
      {good + "POINTS 99999999999999\nDATA ascii\n", "POINTS '99999999999999'"},
      {good + "WIDTH 1000000000000\nHEIGHT 1000000000000\nDATA ascii\n", "2^40"},
      {good + "POINTS 1\nDATA zip\n", "DATA 'zip'"},
      {good + "POINTS 1\nDATA\n", "DATA ''"},
      {good + "COLOUR red\nPOINTS 1\nDATA ascii\n", "unknown entry 'COLOUR'"},
      {"FIELDS x y z\nSIZE 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n", "3 FIELDS, 2 SIZE"},
      {"FIELDS x y z\nTYPE F F F\nPOINTS 1\nDATA ascii\n", "0 SIZE"},
      {"SIZE 4\nTYPE F\nPOINTS 1\nDATA ascii\n", "0 FIELDS"},
      {"FIELDS x y z\nSIZE 4 4 0\nTYPE F F F\nPOINTS 1\nDATA ascii\n", "SIZE '0'"},
      {"FIELDS x y z\nSIZE 4 4 -4\nTYPE F F F\nPOINTS 1\nDATA ascii\n", "SIZE '-4'"},
      {"FIELDS a b\nSIZE 8 8\nTYPE F F\nCOUNT 1000000 1000000\nPOINTS 1\nDATA binary\n",
       "16000000 bytes"},
  };
  for (const auto& [text, expected] : cases) {
    const auto header = parse(text);
    ASSERT_FALSE(header.ok()) << text;
    EXPECT_THAT(header.error().text(), HasSubstr(expected));
    EXPECT_EQ(header.error().where, "h.pcd");
  }
}

TEST(PcdHeader, StopsAtAnEndlessHeader) {
  std::string text;
  while (text.size() < (5U << 20)) text += "# comment\n";
  EXPECT_THAT(parse(text).error().text(), HasSubstr("without a DATA line"));
}

}  // namespace
}  // namespace lvcalib
