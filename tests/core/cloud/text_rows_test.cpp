// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud/text_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lvcalib {
namespace {

TEST(LineReader, ReadsBothLineEndsAndALastLineWithoutOne) {
  for (const std::size_t chunk : {1U, 2U, 5U, 100U}) {
    Input input = Input::from_memory("one\r\n\ntwo three\nfour", "m", chunk);
    LineReader lines(input);
    std::vector<std::string> seen;
    for (auto line = lines.next(); line->has_value(); line = lines.next()) {
      seen.emplace_back(**line);
    }
    EXPECT_THAT(seen, testing::ElementsAre("one", "", "two three", "four"));
    EXPECT_EQ(lines.number(), 4U);
  }
}

TEST(LineReader, RefusesEndlessLines) {
  const std::string text(3 << 20, 'x');
  Input input = Input::from_memory(text, "m");
  LineReader lines(input);
  EXPECT_FALSE(lines.next().ok());
}

TEST(Words, AreCutAtBlanks) {
  std::string_view line = "  a\t b1 \r";
  EXPECT_EQ(next_word(line), "a");
  EXPECT_EQ(next_word(line), "b1");
  EXPECT_EQ(next_word(line), "");
  EXPECT_EQ(parse_count("17"), 17U);
  EXPECT_FALSE(parse_count("-1"));
  EXPECT_FALSE(parse_count("1.5"));
  EXPECT_FALSE(parse_count(""));
  EXPECT_FALSE(parse_count("99999999999999999999999"));
}

Result<Cloud> read_rows(const std::string& text, std::uint64_t points) {
  Input input = Input::from_memory(text, "m");
  LineReader lines(input, 10);
  const std::vector<TextEntry> entries = {{kX}, {-1, 2}, {kY}, {-1, 1, true}, {kZ}};
  CloudBuilder builder(text_layout(entries), false, points);
  const Status status = read_text_rows(input, lines, entries, points, builder);
  if (!status) return status.error();
  return builder.finish("m");
}

TEST(TextRows, SkipOtherFieldsAndLists) {
  const auto cloud = read_rows("\n# note\n 1 9 9 2 3 9 9 9 +3.5\n-1e0\tw w 5 0 6 extra\n", 2);
  ASSERT_TRUE(cloud.ok()) << cloud.error().text();
  ASSERT_EQ(cloud->size(), 2U);
  EXPECT_EQ(cloud->points_m[0], Eigen::Vector3f(1, 2, 3.5F));
  EXPECT_EQ(cloud->points_m[1], Eigen::Vector3f(-1, 5, 6));
}

TEST(TextRows, ErrorsNameLineAndField) {
  EXPECT_THAT(read_rows("1 9 9 two 0 3\n1 9 9 2 0 3\n", 2).error().text(),
              testing::AllOf(testing::HasSubstr("line 11"), testing::HasSubstr("'two'"),
                             testing::HasSubstr("field y")));
  EXPECT_THAT(read_rows("1 9 9 2 0 3\n1 9 9\n1 9 9 2 0 3\n", 3).error().text(),
              testing::AllOf(testing::HasSubstr("line 12"), testing::HasSubstr("after 3 values")));
  EXPECT_THAT(read_rows("1 9 9 2 -1 3\n", 1).error().text(), testing::HasSubstr("'-1'"));
  EXPECT_THAT(read_rows("1 9 9 2 0 3\n1 9 9 2 99", 5).error().text(),
              testing::AllOf(testing::HasSubstr("truncated"), testing::HasSubstr("found 1")));
}

}  // namespace
}  // namespace lvcalib
