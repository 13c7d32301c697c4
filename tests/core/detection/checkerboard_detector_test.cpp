// SPDX-License-Identifier: GPL-3.0-or-later
#include "detection/checkerboard_detector.h"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "support/rendered_board.h"

namespace lvcalib {
namespace {

Target board(int columns, int rows) {
  Target target;
  target.type = TargetType::kCheckerboard;
  target.corner_columns = columns;
  target.corner_rows = rows;
  target.column_spacing_m = target.row_spacing_m = 0.05;
  target.board_width_m = 0.05 * (columns + 3);
  target.board_height_m = 0.05 * (rows + 3);
  return target;
}

double worst_error(const std::vector<CornerObservation>& corners, const Camera& camera,
                   const Rigid3& pose) {
  double out = 0.0;
  for (const CornerObservation& corner : corners) {
    const Eigen::Vector3d point(corner.board_m.x(), corner.board_m.y(), 0);
    out = std::max(out, (*camera.project(pose * point) - corner.pixel).norm());
  }
  return out;
}

// 6 × 5 inner corners: the colours leave one frame at any roll.
TEST(Checkerboard, ColorsDecideTheFrameWhereTheyCan) {
  const Target target = board(6, 5);
  const Camera camera = testing::pinhole(320, 260, 300);
  for (const double roll : {0.0, 0.8, 2.0, 2.8, -1.2}) {
    testing::RenderOptions render;
    render.samples_per_side = 4;
    const Rigid3 pose = testing::facing_pose(target, 0.75, roll, 0.3, 0.2);
    const auto corners =
        find_checkerboard(testing::render_board(target, camera, pose, render), target, {});
    ASSERT_TRUE(corners.ok()) << roll << " " << corners.error().text();
    ASSERT_EQ(corners->corners.size(), 30U);
    EXPECT_FALSE(corners->other_colors);
    EXPECT_LT(worst_error(corners->corners, camera, pose), 0.15) << roll;
  }
}

// 5 × 7: half a turn changes nothing, the upright frame is chosen; never a mirrored one.
TEST(Checkerboard, SymmetricBoardGetsTheUprightFrame) {
  const Target target = board(5, 7);
  const Camera camera = testing::pinhole(320, 300, 300);
  for (const double roll : {0.3, 0.3 + std::numbers::pi}) {
    testing::RenderOptions render;
    render.samples_per_side = 4;
    const Rigid3 upright = testing::facing_pose(target, 0.75, 0.3, 0.2, -0.2);
    const auto image = testing::render_board(
        target, camera, testing::facing_pose(target, 0.75, roll, 0.2, -0.2), render);
    const auto corners = find_checkerboard(image, target, {});
    ASSERT_TRUE(corners.ok());
    if (roll < 1) {
      EXPECT_LT(worst_error(corners->corners, camera, upright), 0.15);
    }
    const Eigen::Vector2d x = corners->corners[4].pixel - corners->corners[0].pixel;
    const Eigen::Vector2d y = corners->corners[30].pixel - corners->corners[0].pixel;
    EXPECT_LT(y.y(), 0.0);
    EXPECT_LT(x.x() * y.y() - x.y() * y.x(), 0.0);
  }
}

TEST(Checkerboard, MissingBoardIsAnError) {
  const Target target = board(5, 7);
  const GrayImage image{200, 150, std::vector<float>(200 * 150, 80.0F)};
  const auto corners = find_checkerboard(image, target, {});
  ASSERT_FALSE(corners.ok());
  EXPECT_NE(corners.error().message.text().find("5 × 7"), std::string::npos);
}

// 5 × 7 squares' corners look the same after half a turn: only the image knows which are black.
// Squares counted instead of inner corners, a row forgotten, and both exchanged: a board that is
// found either way round is found then, too.
TEST(Checkerboard, AnotherCountIsNamed) {
  const Target target = board(7, 5);
  const Camera camera = testing::pinhole(320, 300, 300);
  const GrayImage image =
      testing::render_board(target, camera, testing::facing_pose(target, 0.85, 0.2, 0.2, -0.2), {});
  for (const auto& [columns, rows] : {std::pair(8, 6), std::pair(6, 5), std::pair(7, 4)}) {
    const auto corners = find_checkerboard(image, board(columns, rows), {});
    ASSERT_FALSE(corners.ok()) << columns << " × " << rows;
    const std::string text = corners.error().text();
    EXPECT_NE(text.find("targetCols: 7 and targetRows: 5 would fit"), std::string::npos) << text;
  }
  EXPECT_TRUE(find_checkerboard(image, board(5, 7), {}).ok());
  // A board that cannot be this one is not offered.
  const auto corners = find_checkerboard(image, board(16, 11), {});
  ASSERT_FALSE(corners.ok());
  EXPECT_EQ(corners.error().text().find("would fit"), std::string::npos);
}

TEST(Checkerboard, SaysWhenTheColorsAreTheOtherWayRound) {
  Target target = board(5, 7);
  const Camera camera = testing::pinhole(320, 300, 350);
  const Rigid3 pose = testing::facing_pose(target, 1.0, 0.1, 0.2, 0.1);
  for (const bool white_first : {false, true}) {
    target.white_first = white_first;
    const auto image = testing::render_board(target, camera, pose, {});
    for (const bool said : {false, true}) {
      Target told = target;
      told.white_first = said;
      const auto corners = find_checkerboard(image, told, {});
      ASSERT_TRUE(corners.ok());
      EXPECT_EQ(corners->other_colors, said != white_first);
    }
  }
}

TEST(Checkerboard, TwoOfThemAreAnError) {
  const Target target = board(5, 7);
  const Camera camera = testing::pinhole(640, 300, 350);
  Rigid3 pose = testing::facing_pose(target, 1.0, 0.1, 0.2, 0.1);
  pose.translation.x() -= 0.4;
  auto both = testing::render_board(target, camera, pose, {});
  pose.translation.x() += 0.8;
  const auto second = testing::render_board(target, camera, pose, {});
  for (int y = 0; y < both.height_px; ++y) {
    for (int x = both.width_px / 2; x < both.width_px; ++x) {
      const auto i = static_cast<std::size_t>(y * both.width_px + x);
      both.pixels[i] = second.pixels[i];
    }
  }
  EXPECT_TRUE(find_checkerboard(second, target, {}).ok());
  const auto corners = find_checkerboard(both, target, {});
  ASSERT_FALSE(corners.ok());
  EXPECT_NE(corners.error().message.text().find("two checkerboards"), std::string::npos);
}

TEST(Checkerboard, AllRealImagesAreFound) {
  const auto data = testing::shared_data();
  if (!data) GTEST_SKIP() << "shared data not found";
  const auto folder = *data / "real/vlp16-checkerboard";
  const auto target = read_target(folder / "target.yaml");
  ASSERT_TRUE(target.ok());
  int found = 0;
  for (int pose = 1; pose < 40; pose += 2) {
    const std::string name = (pose < 10 ? "pose0" : "pose") + std::to_string(pose);
    const auto image = read_image(folder / "scenes" / name / "image.png");
    ASSERT_TRUE(image.ok());
    found += find_checkerboard(*image, target->target, {}).ok() ? 1 : 0;
  }
  EXPECT_EQ(found, 20);
}

}  // namespace
}  // namespace lvcalib
