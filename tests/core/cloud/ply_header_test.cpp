// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud/ply_header.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lvcalib {
namespace {

using testing::HasSubstr;

Result<PlyHeader> parse(const std::string& text) {
  Input input = Input::from_memory(text, "h.ply");
  return read_ply_header(input);
}

TEST(PlyHeader, ReadsElementsListsAndComments) {
  const auto header = parse(
      "ply\r\nformat binary_big_endian 1.0\r\ncomment made by hand\r\nobj_info anything goes\r\n"
      "element face 2\r\nproperty list uchar int vertex_index\r\nelement vertex 5\r\n"
      "property double x\r\nproperty uint8 red\r\nend_header\r\n");
  ASSERT_TRUE(header.ok()) << header.error().text();
  EXPECT_EQ(header->format, PlyFormat::kBigEndian);
  EXPECT_EQ(header->vertex, 1U);
  EXPECT_EQ(header->vertices().count, 5U);
  EXPECT_EQ(header->vertices().scalar_bytes(), 9U);
  EXPECT_TRUE(header->elements[0].has_list());
  EXPECT_FALSE(header->vertices().has_list());
  EXPECT_EQ(header->line_count, 10U);
}

TEST(PlyHeader, RefusesWhatIsMalformed) {
  const struct {
    std::string text, expected;
  } cases[] = {
      {"ply\n", "without an end_header"},
      {"plyx\nend_header\n", "expected 'ply'"},
      {"ply\nelement vertex 1\nend_header\n", "no format line"},
      {"ply\nformat ascii 1.0\nend_header\n", "no element 'vertex'"},
      {"ply\nformat text 1.0\nend_header\n", "line 2: format 'text'"},
      {"ply\nformat ascii 1.0\nelement vertex -1\n", "'-1' is not a number"},
      {"ply\nformat ascii 1.0\nelement vertex 9999999999999\n", "is not a number"},
      {"ply\nformat ascii 1.0\nproperty float x\n", "before the first element"},
      {"ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\n", "unknown type 'quad'"},
      {"ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int x\n", "integer type"},
      {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float\n", "without a name"},
      {"ply\nformat ascii 1.0\nelephant\n", "unknown entry 'elephant'"},
  };
  for (const auto& [text, expected] : cases) {
    const auto header = parse(text);
    ASSERT_FALSE(header.ok()) << text;
    EXPECT_THAT(header.error().text(), HasSubstr(expected));
  }
}

}  // namespace
}  // namespace lvcalib
