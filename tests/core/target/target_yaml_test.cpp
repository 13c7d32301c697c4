// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "target/target.h"
#include "target/target_text.h"

namespace lvcalib {
namespace {
using ::testing::HasSubstr;

class TargetYaml : public ::testing::Test {
 protected:
  void SetUp() override {
    path_ = std::filesystem::temp_directory_path() /
            ("lvcalib_target_" + std::to_string(::getpid()) + ".yaml");
  }
  void TearDown() override { std::filesystem::remove(path_); }

  Result<TargetFile> read(const std::string& text) const {
    std::ofstream(path_) << text;
    return read_target(path_);
  }
  [[nodiscard]] std::string error(const std::string& text) const {
    const auto file = read(text);
    EXPECT_FALSE(file.ok()) << text;
    if (file) return {};
    EXPECT_EQ(file.error().kind, ErrorKind::kInput);
    EXPECT_THAT(file.error().where, HasSubstr(path_.string()));
    return file.error().text();
  }
  std::filesystem::path path_;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

const char* const kGrid = R"(target_type: aprilgrid_circles
tagFamily: tag36h11
tagCols: 5
tagRows: 3
tagSize: 0.10        # m
tagSpacing: 0.9
tagBorder: 2
firstTagId: 7
circleRadius: 0.04
margin: 0.05
)";

const char* const kChecker = R"(target_type: checkerboard
targetCols: 5
targetRows: 7
colSpacingMeters: 0.095
rowSpacingMeters: 0.09
boardWidth: 0.61
boardHeight: 0.85
boardOffset: [0.002, -0.001]
)";

const char* const kCharuco = R"(target_type: charuco
targetCols: 6
targetRows: 8
squareSize: 0.09
markerSize: 0.066
dictionary: DICT_5X5_250
firstMarkerId: 12
legacyPattern: true
boardWidth: 0.6
boardHeight: 0.8
boardOffset: [0.01, -0.02]
)";

const char* const kSingleTag = R"(target_type: apriltag
tagFamily: tag25h9
tagId: 4
tagSize: 0.5
tagBorder: 2
boardWidth: 0.7
boardHeight: 0.8
boardOffset: [0.02, 0.03]
)";

void expect_same(const Target& a, const Target& b) {
  EXPECT_EQ(to_yaml(a), to_yaml(b));
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(a.outline().lower_left_m, b.outline().lower_left_m);
  EXPECT_EQ(a.outline().upper_right_m, b.outline().upper_right_m);
}

TEST_F(TargetYaml, ReadsEveryKeyOfAGrid) {
  const auto file = read(kGrid);
  ASSERT_TRUE(file.ok()) << file.error().text();
  EXPECT_TRUE(file->warnings.empty());
  const Target& t = file->target;
  EXPECT_EQ(t.type, TargetType::kAprilGridCircles);
  EXPECT_EQ(t.tag_columns, 5);
  EXPECT_EQ(t.tag_rows, 3);
  EXPECT_EQ(t.tag_size_m, 0.10);
  EXPECT_EQ(t.tag_spacing, 0.9);
  EXPECT_EQ(t.tag_border_bits, 2);
  EXPECT_EQ(t.first_tag_id, 7);
  EXPECT_EQ(t.circle_radius_m, 0.04);
  EXPECT_EQ(t.margin_m, 0.05);
}

TEST_F(TargetYaml, ReadsKalibrsOwnGridWithDefaults) {
  const auto file =
      read("target_type: 'aprilgrid'\ntagCols: 6\ntagRows: 6\ntagSize: 0.088\ntagSpacing: 0.3\n");
  ASSERT_TRUE(file.ok()) << file.error().text();
  EXPECT_EQ(file->target.type, TargetType::kAprilGrid);
  EXPECT_EQ(file->target.tag_family, "tag36h11");
  EXPECT_EQ(file->target.tag_border_bits, 1);
  EXPECT_EQ(file->target.first_tag_id, 0);
  EXPECT_TRUE(file->target.nodes().empty());
}

TEST_F(TargetYaml, ReadsCheckerboards) {
  const auto file = read(kChecker);
  ASSERT_TRUE(file.ok()) << file.error().text();
  EXPECT_EQ(file->target.corner_columns, 5);
  EXPECT_EQ(file->target.corner_rows, 7);
  EXPECT_EQ(file->target.column_spacing_m, 0.095);
  EXPECT_EQ(file->target.row_spacing_m, 0.09);
  EXPECT_EQ(file->target.board_width_m, 0.61);
  EXPECT_EQ(file->target.board_offset_m, Eigen::Vector2d(0.002, -0.001));
  // Without an outline: the pattern with its outer squares.
  const auto bare = read(
      "target_type: checkerboard\ntargetCols: 5\ntargetRows: 7\ncolSpacingMeters: 0.1\n"
      "rowSpacingMeters: 0.1\n");
  ASSERT_TRUE(bare.ok());
  EXPECT_NEAR(bare->target.board_width_m, 0.6, 1e-12);
  EXPECT_NEAR(bare->target.board_height_m, 0.8, 1e-12);
}

// Kalibr's files have no outline, by which clouds are searched; columns and rows that are exchanged
// do not fit theirs.
TEST_F(TargetYaml, ACheckerboardThatItsOutlineDoesNotFitIsWarnedOf) {
  const std::string whole = kChecker;
  EXPECT_TRUE(read(whole)->warnings.empty());
  const auto bare = read(whole.substr(0, whole.find("boardWidth")));
  ASSERT_TRUE(bare.ok());
  ASSERT_EQ(bare->warnings.size(), 1U);
  EXPECT_THAT(bare->warnings[0], HasSubstr("without boardWidth and boardHeight"));
  const auto exchanged = read(replaced(replaced(kChecker, "targetCols: 5", "targetCols: 7"),
                                       "targetRows: 7", "targetRows: 5"));
  ASSERT_TRUE(exchanged.ok());
  ASSERT_EQ(exchanged->warnings.size(), 1U);
  EXPECT_THAT(exchanged->warnings[0], HasSubstr("77 mm beyond"));
  EXPECT_THAT(exchanged->warnings[0], HasSubstr("targetCols: 5 and targetRows: 7"));
  const auto small = read(replaced(kChecker, "boardWidth: 0.61", "boardWidth: 0.51"));
  ASSERT_TRUE(small.ok());
  ASSERT_EQ(small->warnings.size(), 1U);
  EXPECT_THAT(small->warnings[0], HasSubstr("32 mm beyond the board's outline; measure"));
}

TEST_F(TargetYaml, WritesWhatItReads) {
  for (const char* text : {kGrid, kChecker, kCharuco, kSingleTag}) {
    const auto first = read(text);
    ASSERT_TRUE(first.ok());
    const auto second = read(to_yaml(first->target));
    ASSERT_TRUE(second.ok()) << second.error().text();
    EXPECT_TRUE(second->warnings.empty());
    expect_same(first->target, second->target);
  }
  Target odd;
  odd.type = TargetType::kAprilGrid;
  odd.tag_size_m = 1.0 / 7.0;
  odd.tag_spacing = 1.0 / 3.0;
  const auto again = read(to_yaml(odd));
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->target.tag_size_m, odd.tag_size_m);
  expect_same(again->target, odd);
}

TEST_F(TargetYaml, ReadsEveryKeyOfACharucoBoard) {
  const auto file = read(kCharuco);
  ASSERT_TRUE(file.ok()) << file.error().text();
  EXPECT_TRUE(file->warnings.empty());
  const Target& t = file->target;
  EXPECT_EQ(t.type, TargetType::kCharuco);
  EXPECT_EQ(t.corner_columns, 5);
  EXPECT_EQ(t.corner_rows, 7);
  EXPECT_EQ(t.column_spacing_m, 0.09);
  EXPECT_EQ(t.row_spacing_m, 0.09);
  EXPECT_EQ(t.tag_size_m, 0.066);
  EXPECT_EQ(t.tag_family, "DICT_5X5_250");
  EXPECT_EQ(t.first_tag_id, 12);
  EXPECT_TRUE(t.legacy_pattern);
  EXPECT_EQ(t.outline().size_m(), Eigen::Vector2d(0.6, 0.8));
  // Without an outline the board ends with its squares; DICT_ may be left out.
  const auto bare = read(
      "target_type: charuco\ntargetCols: 5\ntargetRows: 7\nsquareSize: 0.1\nmarkerSize: 0.07\n"
      "dictionary: 4X4_50\n");
  ASSERT_TRUE(bare.ok()) << bare.error().text();
  EXPECT_TRUE(bare->target.outline().size_m().isApprox(Eigen::Vector2d(0.5, 0.7)));
  EXPECT_EQ(bare->target.tag_family, "DICT_4X4_50");
  EXPECT_FALSE(bare->target.legacy_pattern);
}

TEST_F(TargetYaml, ReadsEveryKeyOfASingleTag) {
  const auto file = read(kSingleTag);
  ASSERT_TRUE(file.ok()) << file.error().text();
  EXPECT_TRUE(file->warnings.empty());
  const Target& t = file->target;
  EXPECT_EQ(t.type, TargetType::kAprilTag);
  EXPECT_EQ(t.tag_family, "tag25h9");
  EXPECT_EQ(t.first_tag_id, 4);
  EXPECT_EQ(t.tag_size_m, 0.5);
  EXPECT_EQ(t.tag_border_bits, 2);
  EXPECT_EQ(t.board_offset_m, Eigen::Vector2d(0.02, 0.03));
  const auto bare = read("target_type: apriltag\ntagId: 0\ntagSize: 0.8\n");
  ASSERT_TRUE(bare.ok()) << bare.error().text();
  // A white border of one of the eight bits along a side.
  EXPECT_TRUE(bare->target.outline().size_m().isApprox(Eigen::Vector2d(1.0, 1.0)));
}

TEST_F(TargetYaml, SaysWhatIsWrongWithACharucoBoardOrTag) {
  EXPECT_THAT(error(replaced(kCharuco, "DICT_5X5_250", "DICT_5X5_20")), HasSubstr("dictionary"));
  EXPECT_THAT(error(replaced(kCharuco, "firstMarkerId: 12", "firstMarkerId: 240")),
              HasSubstr("do not exist in DICT_5X5_250, which has 250"));
  EXPECT_THAT(error(replaced(kCharuco, "0.066", "0.09")), HasSubstr("markerSize smaller"));
  EXPECT_THAT(error(replaced(kCharuco, "legacyPattern: true", "legacyPattern: maybe")),
              HasSubstr("expected true or false"));
  EXPECT_THAT(error(replaced(kCharuco, "boardWidth: 0.6", "boardWidth: 0.5")),
              HasSubstr("beyond the board's outline"));
  EXPECT_THAT(error(replaced(replaced(kCharuco, "targetCols: 6", "targetCols: 8"), "targetRows: 8",
                             "targetRows: 6")),
              HasSubstr("with targetCols: 6 and targetRows: 8 it would not"));
  EXPECT_THAT(error(replaced(kCharuco, "markerSize: 0.066\n", "")), HasSubstr("markerSize"));
  EXPECT_THAT(error(replaced(kSingleTag, "tagId: 4\n", "")), HasSubstr("tagId"));
  EXPECT_THAT(error(replaced(kSingleTag, "tagId: 4", "tagId: 35")), HasSubstr("do not exist"));
  EXPECT_THAT(error(replaced(kSingleTag, "tagSize: 0.5", "tagSize: .nan")), HasSubstr("tagSize"));
  EXPECT_THAT(error(replaced(kSingleTag, "tagSize: 0.5", "tagSize: 0")), HasSubstr("positive"));
}

TEST_F(TargetYaml, WarnsOfUnknownKeysWithTheNearestKnownOne) {
  const auto file = read(replaced(kGrid, "tagBorder", "tagBoarder"));
  ASSERT_TRUE(file.ok());
  ASSERT_EQ(file->warnings.size(), 1U);
  EXPECT_THAT(file->warnings[0], HasSubstr(":7: unknown key 'tagBoarder'"));
  EXPECT_THAT(file->warnings[0], HasSubstr("did you mean 'tagBorder'?"));
  EXPECT_EQ(file->target.tag_border_bits, 1);
}

TEST_F(TargetYaml, RefusesBadGrids) {
  EXPECT_THAT(error(replaced(kGrid, "target_type: aprilgrid_circles\n", "")),
              HasSubstr("'target_type' is missing"));
  EXPECT_THAT(
      error(replaced(kGrid, "aprilgrid_circles", "circlegrid")),
      HasSubstr("expected aprilgrid_circles, aprilgrid, checkerboard, charuco or apriltag"));
  for (const char* key : {"tagCols", "tagRows", "tagSize", "tagSpacing", "circleRadius"}) {
    EXPECT_THAT(error(replaced(kGrid, key, "other")),
                HasSubstr("key '" + std::string(key) + "' is missing"));
  }
  EXPECT_THAT(error(replaced(kGrid, "0.10", "big")), HasSubstr(":5: 'tagSize' must be a number"));
  EXPECT_THAT(error(replaced(kGrid, "0.10", ".nan")), HasSubstr("found '.nan'"));
  EXPECT_THAT(error(replaced(kGrid, "0.10", "[0.1]")), HasSubstr("a list of 1"));
  EXPECT_THAT(error(replaced(kGrid, "0.10", "0")), HasSubstr("positive"));
  EXPECT_THAT(error(replaced(kGrid, "0.10", "-1")), HasSubstr("between 0 and 100"));
  EXPECT_THAT(error(replaced(kGrid, "0.10", "120")), HasSubstr("(lengths are in metres)"));
  EXPECT_THAT(error(replaced(kGrid, "tagCols: 5", "tagCols: 2.5")), HasSubstr("whole number"));
  EXPECT_THAT(error(replaced(kGrid, "tagCols: 5", "tagCols: 1")), HasSubstr("2 × 2 tags"));
  EXPECT_THAT(error(replaced(kGrid, "tagCols: 5", "tagCols: 900")), HasSubstr("do not exist"));
  EXPECT_THAT(error(replaced(kGrid, "firstTagId: 7", "firstTagId: 573")),
              HasSubstr("which has 587"));
  EXPECT_THAT(error(replaced(kGrid, "tagBorder: 2", "tagBorder: 3")), HasSubstr("between 1 and 2"));
  EXPECT_THAT(error(replaced(kGrid, "tag36h11", "tag99h1")), HasSubstr("is not known"));
  EXPECT_THAT(error(replaced(kGrid, "0.04\n", "0.09\n")), HasSubstr("circles run into the tags"));
}

TEST_F(TargetYaml, RefusesBadCheckerboardsAndStrangers) {
  EXPECT_THAT(error(replaced(kChecker, "targetCols: 5", "targetCols: 2")), HasSubstr("between 3"));
  EXPECT_THAT(error(replaced(kChecker, "0.095", "0")), HasSubstr("positive"));
  EXPECT_THAT(error(replaced(kChecker, "0.61", "0.2")), HasSubstr("smaller than its pattern"));
  EXPECT_THAT(error(replaced(kChecker, "[0.002, -0.001]", "[0.002]")),
              HasSubstr("2 numbers, found 1"));
  EXPECT_THAT(error("a: [1"), HasSubstr("not valid YAML"));
  EXPECT_THAT(error("- 1\n"), HasSubstr("expected a YAML map"));
  EXPECT_FALSE(read_target("/nonexistent/target.yaml").ok());
}

TEST_F(TargetYaml, AMeasuredLengthIsThePrintsSize) {
  const std::string measured = "measuredLength: 0.4985\ndrawnLength: 0.5\nmeasuredSigma: 0.0002\n";
  const auto plain = read(kGrid);
  const auto grid = read(std::string(kGrid) + measured);
  ASSERT_TRUE(plain && grid);
  EXPECT_TRUE(grid->warnings.empty());
  EXPECT_EQ(plain->target.size_sigma, 0.0);
  EXPECT_NEAR(grid->target.tag_size_m, 0.0997, 1e-12);
  EXPECT_NEAR(grid->target.circle_radius_m, 0.03988, 1e-12);
  EXPECT_NEAR(grid->target.tag_spacing, 0.9, 1e-12);  // a ratio
  EXPECT_NEAR(grid->target.size_sigma, 0.0002 / 0.4985, 1e-12);
  // The board that the print is glued to is as large as it is.
  const auto squares = read(std::string(kChecker) + measured);
  ASSERT_TRUE(squares);
  EXPECT_NEAR(squares->target.column_spacing_m, 0.095 * 0.997, 1e-12);
  EXPECT_NEAR(squares->target.board_width_m, 0.61, 1e-12);
  // Written and read again it is the same board, not one scaled twice.
  const auto again = read(to_yaml(grid->target));
  ASSERT_TRUE(again);
  EXPECT_NEAR(again->target.tag_size_m, grid->target.tag_size_m, 1e-12);
  EXPECT_NEAR(again->target.size_sigma, grid->target.size_sigma, 1e-12);
  // Without a standard deviation half a millimetre of a rule.
  const auto rule = read(std::string(kGrid) + "measuredLength: 0.5\ndrawnLength: 0.5\n");
  ASSERT_TRUE(rule);
  EXPECT_NEAR(rule->target.size_sigma, 0.001, 1e-12);
  for (const char* wrong :
       {"measuredLength: 0.5\n", "drawnLength: 0.5\n", "measuredLength: 500\ndrawnLength: 0.5\n",
        "measuredLength: -0.5\ndrawnLength: 0.5\n", "measuredLength: abc\ndrawnLength: 0.5\n"})
    EXPECT_THAT(error(std::string(kGrid) + wrong), HasSubstr("Length")) << wrong;
}

TEST_F(TargetYaml, ATextIsReadAsItsFileWouldBe) {
  const auto file = read(kGrid);
  const auto text = target_from_text(kGrid, "the form");
  ASSERT_TRUE(file && text);
  EXPECT_EQ(to_yaml(text->target), to_yaml(file->target));
  const auto wrong = target_from_text(replaced(kGrid, "tagCols", "tagColumns"), "the form");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().message, read(replaced(kGrid, "tagCols", "tagColumns")).error().message);
  EXPECT_THAT(wrong.error().text(), HasSubstr("the form"));
}

}  // namespace
}  // namespace lvcalib
