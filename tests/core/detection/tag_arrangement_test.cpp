// SPDX-License-Identifier: GPL-3.0-or-later
#include "detection/tag_arrangement.h"

#include <string>

#include <gtest/gtest.h>

#include "support/ordinary_boards.h"
#include "support/rendered_board.h"

namespace lvcalib {
namespace {

// The tags of a board as its image shows them, to a twentieth of a pixel.
class OtherTagGrid : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<BoardTag> seen(const Target& board) const {
    const Rigid3 pose = testing::facing_pose(board, 2.0, 0.1, 0.3, -0.2);
    std::vector<BoardTag> tags;
    for (const TargetTag& tag : board.tags()) {
      BoardTag out{tag.id, {}, {}, true, 100.0};
      out.sigma_px.fill(0.05);
      const auto corners = board.tag_corners_m(tag);
      for (std::size_t k = 0; k < 4; ++k)
        out.corners[k] =
            *camera_.project(pose * Eigen::Vector3d(corners[k].x(), corners[k].y(), 0));
      tags.push_back(out);
    }
    return tags;
  }
  Camera camera_ = testing::pinhole(800, 500, 600);
  Target board_;  // 4 × 4 tags
};

TEST_F(OtherTagGrid, TheRightDescriptionNeedsNoOther) {
  EXPECT_EQ(other_grid(seen(board_), board_, camera_, {}), std::nullopt);
  EXPECT_EQ(other_arrangement(seen(board_), board_, camera_, {}), std::nullopt);
}

TEST_F(OtherTagGrid, AnotherCountIsNamed) {
  const auto tags = seen(board_);
  Target said = board_;
  said.first_tag_id = 4;
  EXPECT_EQ(other_grid(tags, said, camera_, {})->text(), "firstTagId: 0");
  said.first_tag_id = 100;
  EXPECT_EQ(other_grid(tags, said, camera_, {})->text(), "firstTagId: 0");
  said = board_;
  said.tag_columns = 5;
  EXPECT_EQ(other_grid(tags, said, camera_, {})->text(), "tagCols: 4");
  said.tag_columns = 3;
  EXPECT_EQ(other_grid(tags, said, camera_, {})->text(), "tagCols: 4");
  said = board_;
  said.tag_rows = 3;
  EXPECT_EQ(other_grid(tags, said, camera_, {})->text(), "tagRows: 4");
}

TEST_F(OtherTagGrid, AnotherCountOfACharucoBoardIsNamed) {
  for (const Target& board : {test::charuco_target(), test::legacy_charuco_target()}) {
    const std::string columns = std::to_string(board.corner_columns + 1);
    const auto tags = seen(board);
    EXPECT_EQ(other_grid(tags, board, camera_, {}), std::nullopt);
    Target said = board;
    said.first_tag_id += 5;
    EXPECT_EQ(other_grid(tags, said, camera_, {})->text(),
              "firstMarkerId: " + std::to_string(board.first_tag_id));
    said = board;
    ++said.corner_columns;
    EXPECT_EQ(other_grid(tags, said, camera_, {})->text(), "targetCols: " + columns);
    said.corner_columns -= 2;
    EXPECT_EQ(other_grid(tags, said, camera_, {})->text(), "targetCols: " + columns);
    said = board;
    said.corner_rows -= 2;
    EXPECT_EQ(other_grid(tags, said, camera_, {})->text(),
              "targetRows: " + std::to_string(board.corner_rows + 1));
  }
}

TEST_F(OtherTagGrid, AnotherSpacingIsNamed) {
  Target said = board_;
  said.tag_spacing = 0.3;
  const auto grid = other_grid(seen(board_), said, camera_, {});
  ASSERT_TRUE(grid.has_value());
  double spacing = 0.0;
  ASSERT_EQ(std::sscanf(grid->text().c_str(), "tagSpacing: about %lf", &spacing), 1)
      << grid->text();
  EXPECT_NEAR(spacing, board_.tag_spacing, 0.03);
}

TEST_F(OtherTagGrid, WithoutAFitNothingIsSaid) {
  auto tags = seen(board_);
  // Corners drawn from nowhere.
  for (std::size_t t = 0; t < tags.size(); ++t) {
    for (auto& corner : tags[t].corners)
      corner += Eigen::Vector2d(40.0 * std::sin(5.0 * static_cast<double>(t)), 60.0);
  }
  Target said = board_;
  said.tag_columns = 5;
  EXPECT_EQ(other_grid(tags, said, camera_, {}), std::nullopt);
}

}  // namespace
}  // namespace lvcalib
