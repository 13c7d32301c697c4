// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/printed_board.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.h"
#include "support/ordinary_boards.h"

namespace lvcalib::simulation {
namespace {

Target checkerboard() {
  Target target;
  target.type = TargetType::kCheckerboard;
  target.corner_columns = 7;
  target.corner_rows = 5;
  target.column_spacing_m = 0.08;
  target.row_spacing_m = 0.08;
  target.board_width_m = 0.8;
  target.board_height_m = 0.6;
  target.board_offset_m = {0.01, -0.01};
  return target;
}

Target kalibr_grid() {
  Target target;
  target.type = TargetType::kAprilGrid;
  target.tag_columns = 6;
  target.tag_rows = 5;
  target.tag_size_m = 0.088;
  target.tag_spacing = 0.3;
  target.tag_border_bits = 2;
  return target;
}

class PrintedBoardOf : public testing::TestWithParam<Target> {};

TEST_P(PrintedBoardOf, AgreesWithTheTargetsAlbedo) {
  const Target target = GetParam();
  const PrintedBoard board(target);
  Random random(7);
  int black = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(-0.2, 1.2);
    const double y = random.uniform(-0.2, 1.2);
    const auto albedo = target.albedo({x, y});
    ASSERT_EQ(albedo.has_value(), board.inside(x, y)) << x << " " << y;
    if (!albedo) continue;
    ASSERT_EQ(*albedo > 0.5, board.is_white(x, y)) << x << " " << y;
    if (*albedo < 0.5) ++black;
  }
  EXPECT_GT(black, 500);
}

// A point has the other colour if anything of that lies within the growth; asked of a dense disc.
TEST_P(PrintedBoardOf, BlackGrowsByADisc) {
  constexpr int kRings = 8;
  constexpr int kRim = 48;
  const PrintedBoard board(GetParam());
  Random random(9);
  for (const double growth : {0.002, -0.002}) {
    int changed = 0;
    int missed = 0;
    for (int i = 0; i < 20000; ++i) {
      const Eigen::Vector2d p(random.uniform(0.0, 0.6), random.uniform(0.0, 0.5));
      const bool white = board.is_white(p.x(), p.y());
      bool other = false;
      for (int k = 0; k < kRings * kRim && white == (growth > 0.0) && !other; ++k) {
        const double angle = 2.0 * std::numbers::pi * (k % kRim) / kRim;
        const double radius = std::abs(growth) * (1 + k / kRim) / kRings;
        other = board.is_white(p.x() + radius * std::cos(angle),
                               p.y() + radius * std::sin(angle)) != white;
      }
      const bool grown = board.reflectivity(p.x(), p.y(), growth) == PrintedBoard::kWhite;
      changed += grown != white ? 1 : 0;
      // The disc's points miss what lies between them, never the other way round.
      if (other) ASSERT_NE(grown, white) << p.transpose();
      missed += grown != white && !other ? 1 : 0;
    }
    EXPECT_GT(changed, 300);
    EXPECT_LT(missed, 0.02 * changed);
  }
}

TEST_P(PrintedBoardOf, NothingChangesWithinTheClearance) {
  const PrintedBoard board(GetParam());
  Random random(8);
  int clear = 0;
  for (int i = 0; i < 3000; ++i) {
    const double x = random.uniform(-0.1, 1.1);
    const double y = random.uniform(-0.1, 1.1);
    const double clearance = board.clearance_m(x, y);
    if (clearance <= 0.0) continue;
    ++clear;
    for (int k = 0; k < 32; ++k) {
      const double nx = x + clearance * std::cos(0.2 * k);
      const double ny = y + clearance * std::sin(0.2 * k);
      ASSERT_TRUE(board.inside(nx, ny));
      ASSERT_EQ(board.is_white(nx, ny), board.is_white(x, y)) << x << " " << y;
    }
  }
  EXPECT_GT(clear, 300);
}

INSTANTIATE_TEST_SUITE_P(Targets, PrintedBoardOf,
                         testing::Values(Target{}, kalibr_grid(), checkerboard(),
                                         test::charuco_target(), test::legacy_charuco_target(),
                                         test::single_tag_target()));

TEST(PrintedBoard, ClearanceIsNearlyTheDistanceToTheNearestEdge) {
  const Target target;
  const PrintedBoard board(target);
  const Eigen::Vector2d center = target.nodes()[0].center_m;
  EXPECT_NEAR(board.clearance_m(center.x(), center.y()), target.circle_radius_m, 0.003);
  EXPECT_EQ(board.clearance_m(-1.0, 0.0), 0.0);
}

}  // namespace
}  // namespace lvcalib::simulation
