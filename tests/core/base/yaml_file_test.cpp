// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/yaml_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lvcalib {
namespace {
using ::testing::ElementsAre;
using ::testing::HasSubstr;

YamlFile parsed(const std::string& text) {
  auto file = YamlFile::parse(text, "f.yaml");
  EXPECT_TRUE(file.ok()) << file.error().text();
  return *file;
}

template <class T>
std::string error(const Result<T>& result) {
  EXPECT_FALSE(result.ok());
  return result.ok() ? std::string{} : result.error().text();
}

TEST(YamlFile, TypedAccess) {
  const YamlFile file = parsed(
      "a: 1.5e-3\nb: 7\nc: word\nd: [1, 2, [3, 4]]\ne:\n  f: 2\n  g: [0]\nempty:\n'q': +3\n");
  EXPECT_EQ(*file.number("a"), 1.5e-3);
  EXPECT_EQ(*file.integer("b", 0, 10), 7);
  EXPECT_EQ(*file.string("c"), "word");
  EXPECT_THAT(*file.numbers("d"), ElementsAre(1, 2, 3, 4));
  EXPECT_EQ(*file.number("q"), 3);
  EXPECT_TRUE(file.has("empty"));
  EXPECT_FALSE(file.has("absent"));
  EXPECT_EQ(file.root().find("d")->line, 4);
  const auto section = file.section("e");
  ASSERT_TRUE(section.ok());
  EXPECT_EQ(*section->integer("f", 0, 10), 2);
  EXPECT_EQ(section->root().find("g")->line, 7);
}

TEST(YamlFile, ErrorsNameFileLineKeyAndWhatWasFound) {
  const YamlFile file =
      parsed("a: word\nb: 2.5\nc: [1, x]\nd: {k: 1}\ne: [1, 2]\nn: .nan\ni: .inf\nz:\nh: 0x10\n");
  EXPECT_EQ(error(file.number("a")), "f.yaml:1: 'a' must be a number, found 'word'");
  EXPECT_EQ(error(file.number("b", 3)), "f.yaml:2: 'b' must be at least 3, found '2.5'");
  EXPECT_THAT(error(file.number("b", -1e308, 2)), HasSubstr("must be"));
  EXPECT_EQ(error(file.number("b", 0, 2)), "f.yaml:2: 'b' must be between 0 and 2, found '2.5'");
  EXPECT_EQ(error(file.integer("b", 0, 10)), "f.yaml:2: 'b' must be a whole number, found '2.5'");
  EXPECT_EQ(error(file.numbers("c")), "f.yaml:3: 'c' must hold numbers, found 'x'");
  EXPECT_EQ(error(file.string("d")), "f.yaml:4: 'd' must be a word, found a map");
  EXPECT_EQ(error(file.numbers("d")), "f.yaml:4: 'd' must be a list of numbers, found a map");
  EXPECT_EQ(error(file.numbers("e", 3)), "f.yaml:5: 'e' must hold 3 numbers, found 2");
  EXPECT_EQ(error(file.number("e")), "f.yaml:5: 'e' must be a number, found a list of 2");
  EXPECT_THAT(error(file.number("n")), HasSubstr("found '.nan'"));
  EXPECT_THAT(error(file.number("i")), HasSubstr("found '.inf'"));
  EXPECT_EQ(error(file.number("z")), "f.yaml:8: 'z' must be a number, found nothing");
  EXPECT_THAT(error(file.number("h")), HasSubstr("found '0x10'"));
  EXPECT_EQ(error(file.number("q")), "f.yaml: key 'q' is missing; expected a number");
  EXPECT_THAT(error(file.string("q")), HasSubstr("expected a word"));
  EXPECT_THAT(error(file.numbers("q")), HasSubstr("expected a list"));
  EXPECT_EQ(error(file.section("q")), "f.yaml: key 'q' is missing; expected a map");
  EXPECT_EQ(error(file.section("a")), "f.yaml:1: 'a' must be a map, found 'word'");
}

TEST(YamlFile, AKeyThatIsThereTwiceIsRefused) {
  const auto refused = [](const char* text) {
    const auto file = YamlFile::parse(text, "f.yaml");
    EXPECT_FALSE(file.ok()) << text;
    return file.ok() ? std::string() : file.error().text();
  };
  EXPECT_EQ(refused("tagSize: 0.1\nb: 2\ntagSize: 0.12\n"),
            "f.yaml:3: key 'tagSize' is there twice, first in line 1 (keep the one that is meant)");
  EXPECT_THAT(refused("a:\n  k: 1\n  k: 1\n"), HasSubstr("f.yaml:3: key 'k'"));
  EXPECT_THAT(refused("a:\n  - {k: 1}\n  - {k: 1, k: 2}\n"), HasSubstr("f.yaml:3: key 'k'"));
  EXPECT_TRUE(YamlFile::parse("a: {k: 1}\nb: {k: 1}\nk: 3\n", "f.yaml").ok());
}

TEST(YamlFile, AMissingKeyPointsToItsMisspelling) {
  const YamlFile file = parsed("distorsion_model: plumb_bob\nother: 1\n");
  const Error e = file.string("distortion_model").error();
  EXPECT_THAT(e.text(), HasSubstr("'distorsion_model' a misspelling"));
  EXPECT_TRUE(file.string("camera_matrix").error().hint.empty());
}

TEST(YamlFile, RefusesWhatIsNoMapOrNoYaml) {
  EXPECT_THAT(error(YamlFile::parse("a: [1", "f.yaml")), HasSubstr("f.yaml:"));
  EXPECT_THAT(error(YamlFile::parse("a: [1", "f.yaml")), HasSubstr("not valid YAML"));
  EXPECT_THAT(error(YamlFile::parse("", "f.yaml")), HasSubstr("found nothing"));
  EXPECT_THAT(error(YamlFile::parse("- 1\n- 2\n", "f.yaml")), HasSubstr("a list of 2"));
  EXPECT_THAT(error(YamlFile::parse("word", "f.yaml")), HasSubstr("found 'word'"));
  EXPECT_THAT(error(YamlFile::parse("? [a, b]\n: 1\n", "f.yaml")), HasSubstr("f.yaml"));
  EXPECT_FALSE(YamlFile::parse(std::string("\0\1\2\xff\xfe", 5), "f.yaml").ok());
  EXPECT_FALSE(YamlFile::load("/nonexistent.yaml").ok());
}

TEST(YamlFile, HostileDocumentsEndInAnError) {
  EXPECT_FALSE(YamlFile::parse("a: " + std::string(2000, '['), "f.yaml").ok());
  EXPECT_FALSE(
      YamlFile::parse("a: " + std::string(500, '[') + std::string(500, ']'), "f.yaml").ok());
  EXPECT_FALSE(YamlFile::parse("a: " + std::string(1'000'000, '['), "f.yaml").ok());
  EXPECT_FALSE(YamlFile::parse("a: &a [*a]", "f.yaml").ok());
  // Each line refers ten times to the one before: 10^9 values in a few hundred bytes.
  std::string bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + before;
    for (int k = 0; k < 9; ++k) bomb += ", " + before;
    bomb += "]\n";
  }
  EXPECT_THAT(error(YamlFile::parse(bomb, "f.yaml")), HasSubstr("too large"));
}

TEST(YamlFile, AcceptsOpenCvsFirstLine) {
  const YamlFile file = parsed("%YAML:1.0\n---\nm: !!opencv-matrix\n   rows: 1\n");
  ASSERT_TRUE(file.section("m").ok());
  EXPECT_EQ(*file.section("m")->integer("rows", 0, 5), 1);
  EXPECT_EQ(file.root().find("m")->map[0].second.line, 4);
  EXPECT_FALSE(YamlFile::parse("%YAML:1.0", "f.yaml").ok());
}

TEST(YamlFile, UnknownKeysAreNamedWithTheNearestKnownOne) {
  const YamlFile file = parsed("tagSise: 1\nzzz: 2\ntagCols: 3\n");
  std::vector<std::string> said;
  for (const Message& warning : file.unknown_keys({"tagSize", "tagCols"}))
    said.push_back(warning.text());
  EXPECT_THAT(said, ElementsAre("f.yaml:1: unknown key 'tagSise' ignored; did you mean 'tagSize'?",
                                "f.yaml:2: unknown key 'zzz' ignored"));
}

TEST(NearestWord, IsNearOrNothing) {
  const std::vector<std::string> words{"tagSize", "tagSpacing", "margin"};
  EXPECT_EQ(nearest_word("TAGSIZE", words), "tagSize");
  EXPECT_EQ(nearest_word("tagSpacin", words), "tagSpacing");
  EXPECT_EQ(nearest_word("margins", words), "margin");
  EXPECT_EQ(nearest_word("width", words), "");
  EXPECT_EQ(nearest_word("", words), "");
  EXPECT_EQ(nearest_word("word", {}), "");
}

TEST(ParseNumber, TakesWholeFiniteDecimals) {
  double value = 0;
  EXPECT_TRUE(parse_number("-1.25e2", value));
  EXPECT_EQ(value, -125);
  EXPECT_TRUE(parse_number("+.5", value));
  EXPECT_EQ(value, 0.5);
  for (const char* bad :
       {"", "+", "1x", "1,5", " 1", "nan", "inf", "1e999", "0x10", "--1", "+-1"}) {
    EXPECT_FALSE(parse_number(bad, value)) << bad;
  }
}

}  // namespace
}  // namespace lvcalib
