// SPDX-License-Identifier: GPL-3.0-or-later
// ChArUco boards and single tags: the layout against OpenCV's own drawing of the board.
#include <gtest/gtest.h>
#include <opencv2/aruco/charuco.hpp>

#include "support/ordinary_boards.h"
#include "target/target.h"

namespace lvcalib {
namespace {

// What OpenCV draws, at `px` pixels a square.
cv::Mat drawn_by_opencv(const Target& t, int px) {
  const auto& names = marker_dictionaries();
  const auto number = std::find(names.begin(), names.end(), t.tag_family) - names.begin();
  const auto board = cv::aruco::CharucoBoard::create(
      t.corner_columns + 1, t.corner_rows + 1, static_cast<float>(t.column_spacing_m),
      static_cast<float>(t.tag_size_m),
      cv::aruco::getPredefinedDictionary(static_cast<int>(number)));
  cv::Mat image;
  board->draw({(t.corner_columns + 1) * px, (t.corner_rows + 1) * px}, image, 0, 1);
  return image;
}

// Share of the drawing's pixels, off the edges, on which the target agrees.
double agreement(const Target& t, const cv::Mat& image, int px) {
  const double left = -t.column_spacing_m;
  const double top = t.corner_rows * t.row_spacing_m;
  int compared = 0;
  int same = 0;
  for (int y = 1; y + 1 < image.rows; ++y) {
    for (int x = 1; x + 1 < image.cols; ++x) {
      const cv::Mat near = image(cv::Rect(x - 1, y - 1, 3, 3));
      double low = 0.0;
      double high = 0.0;
      cv::minMaxLoc(near, &low, &high);
      if (low != high) continue;
      const Eigen::Vector2d p(left + (x + 0.5) * t.column_spacing_m / px,
                              top - (y + 0.5) * t.row_spacing_m / px);
      ++compared;
      same += (*t.albedo(p) > 0.5) == (low > 127.0) ? 1 : 0;
    }
  }
  return static_cast<double>(same) / compared;
}

TEST(Charuco, IsTheBoardThatOpenCvDraws) {
  // 88 pixels a square, 64 a marker of 5 bits and its border: 9.14 a bit. OpenCV rounds its
  // corners to whole pixels.
  constexpr int kPx = 88;
  for (const char* dictionary :
       {"DICT_5X5_100", "DICT_4X4_50", "DICT_6X6_250", "DICT_7X7_50", "DICT_APRILTAG_36h11"}) {
    Target t = test::charuco_target();
    t.tag_family = dictionary;
    EXPECT_GT(agreement(t, drawn_by_opencv(t, kPx), kPx), 0.995) << dictionary;
  }
  Target even = test::charuco_target();
  even.corner_rows = 5;
  even.board_height_m = 0.7;
  EXPECT_GT(agreement(even, drawn_by_opencv(even, kPx), kPx), 0.995);
  even.legacy_pattern = true;
  EXPECT_LT(agreement(even, drawn_by_opencv(even, kPx), kPx), 0.5);
}

TEST(Charuco, LegacyLayoutBeginsWhiteWhereRowsAreEven) {
  Target t = test::legacy_charuco_target();
  const double s = t.column_spacing_m;
  const Eigen::Vector2d top_left(-0.95 * s, (t.corner_rows - 0.05) * s);
  EXPECT_EQ(t.albedo(top_left), 1.0);
  t.legacy_pattern = false;
  EXPECT_EQ(t.albedo(top_left), 0.0);
  // With an odd number of rows there is one layout only.
  Target odd = test::charuco_target();
  Target same = odd;
  same.legacy_pattern = true;
  for (double x = -0.1; x < 0.7; x += 0.013) {
    for (double y = -0.1; y < 0.6; y += 0.017) EXPECT_EQ(odd.albedo({x, y}), same.albedo({x, y}));
  }
}

TEST(Charuco, MarkersCountFromTheTopLeft) {
  for (const Target& t : {test::charuco_target(), test::legacy_charuco_target()}) {
    const auto tags = t.tags();
    ASSERT_EQ(static_cast<int>(tags.size()), t.tag_count());
    EXPECT_EQ(tags.front().id, t.first_tag_id);
    for (std::size_t k = 0; k < tags.size(); ++k) {
      EXPECT_EQ(tags[k].id, t.first_tag_id + static_cast<int>(k));
      EXPECT_EQ(t.tag(tags[k].id)->center_m, tags[k].center_m);
      if (k == 0) continue;
      const Eigen::Vector2d step = tags[k].center_m - tags[k - 1].center_m;
      EXPECT_TRUE(step.y() < -1e-6 || (std::abs(step.y()) < 1e-6 && step.x() > 0.0));
    }
    EXPECT_FALSE(t.tag(t.first_tag_id - 1).has_value());
    EXPECT_FALSE(t.tag(t.first_tag_id + t.tag_count()).has_value());
    EXPECT_TRUE(check(t).ok());
  }
}

TEST(Charuco, RefusesWhatCannotBePrinted) {
  const auto refused = [](auto change) {
    Target t = test::charuco_target();
    change(t);
    return !check(t).ok();
  };
  EXPECT_TRUE(refused([](Target& t) { t.tag_size_m = t.column_spacing_m; }));
  EXPECT_TRUE(refused([](Target& t) { t.tag_family = "DICT_5X5_99"; }));
  EXPECT_TRUE(refused([](Target& t) { t.tag_family = "tag36h11"; }));
  EXPECT_TRUE(refused([](Target& t) { t.first_tag_id = 73; }));  // 28 markers, 100 in all
  EXPECT_FALSE(refused([](Target& t) { t.first_tag_id = 72; }));
  EXPECT_TRUE(refused([](Target& t) { t.board_width_m = 0.88; }));  // the offset takes 2 cm
  EXPECT_TRUE(refused([](Target& t) { t.corner_rows = 1; }));
}

TEST(SingleTag, IsATagOnABoardOfItsOwnSize) {
  const Target t = test::single_tag_target();
  EXPECT_TRUE(check(t).ok());
  ASSERT_EQ(t.tags().size(), 1U);
  EXPECT_EQ(t.tags().front().id, 7);
  EXPECT_EQ(t.tags().front().center_m, Eigen::Vector2d(0.3, 0.3));
  EXPECT_TRUE(t.outline().center_m().isApprox(Eigen::Vector2d(0.295, 0.29)));
  EXPECT_EQ(t.albedo({0.01, 0.3}), 0.0);
  EXPECT_EQ(t.albedo({-0.01, 0.3}), 1.0);
  EXPECT_FALSE(t.albedo({0.3, 0.8}).has_value());
  const TagPattern* pattern = tag_pattern("tag36h11", 7);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      const Eigen::Vector2d p =
          Eigen::Vector2d(0.3, 0.3) + t.tag_bit_m() * Eigen::Vector2d(column - 2.5, 2.5 - row);
      EXPECT_EQ(*t.albedo(p) > 0.5, pattern->at(row, column));
    }
  }
  Target bad = t;
  bad.board_width_m = 0.605;
  EXPECT_FALSE(check(bad).ok());
  bad = t;
  bad.tag_family = "DICT_4X4_50";
  EXPECT_FALSE(check(bad).ok());
}

TEST(MarkerDictionaries, HaveTheSizesTheirNamesSay) {
  EXPECT_EQ(marker_dictionaries().size(), 21U);
  EXPECT_EQ(tag_family_size("DICT_4X4_50"), 50);
  EXPECT_EQ(tag_family_size("DICT_7X7_1000"), 1000);
  EXPECT_EQ(tag_family_size("DICT_APRILTAG_36h11"), 587);
  EXPECT_EQ(tag_pattern("DICT_6X6_250", 0)->width, 6);
  EXPECT_EQ(tag_pattern("DICT_6X6_250", 250), nullptr);
  EXPECT_FALSE(is_marker_dictionary("tag36h11"));
  // OpenCV's version of an AprilTag family is the family upside down.
  const TagPattern& own = *tag_pattern("tag36h11", 5);
  const TagPattern& theirs = *tag_pattern("DICT_APRILTAG_36h11", 5);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column)
      EXPECT_EQ(own.at(row, column), theirs.at(5 - row, 5 - column));
  }
}

}  // namespace
}  // namespace lvcalib
