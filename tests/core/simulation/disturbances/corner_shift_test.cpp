// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/disturbances/corner_shift.h"

#include <gtest/gtest.h>

namespace lvcalib::simulation {
namespace {

// A board seen askew: 500 px per metre along x, 300 along y, sheared.
std::optional<Eigen::Vector2d> askew(const Eigen::Vector2d& point) {
  return Eigen::Vector2d(500.0 * point.x() + 60.0 * point.y(), -300.0 * point.y());
}

TEST(CornerShift, CornersMoveOutByTheValueInTheImage) {
  const Target target;
  for (const double shift_px : {0.5, -0.3}) {
    const CornerShift shift(target, shift_px, askew);
    ASSERT_TRUE(shift.active());
    for (const TargetTag& tag : target.tags()) {
      const Eigen::Vector2d center_px = *askew(tag.center_m);
      for (const Eigen::Vector2d& corner : target.tag_corners_m(tag)) {
        const Eigen::Vector2d corner_px = *askew(corner);
        const double radius_px = (corner_px - center_px).norm();
        // The place on the board whose image lies further out by the shift shows the corner.
        const Eigen::Vector2d place =
            tag.center_m + (1.0 + shift_px / radius_px) * (corner - tag.center_m);
        EXPECT_LT((shift.shown_at(place) - corner).norm(), 1e-12);
        EXPECT_NEAR((*askew(place) - corner_px).norm(), std::abs(shift_px), 1e-9);
      }
      EXPECT_LT((shift.shown_at(tag.center_m) - tag.center_m).norm(), 1e-12);
    }
  }
}

TEST(CornerShift, CirclesAndMarginStay) {
  const Target target;
  const CornerShift shift(target, 1.0, askew);
  for (const TargetNode& node : target.nodes()) {
    for (double x = -0.05; x <= 0.05; x += 0.01) {
      for (double y = -0.05; y <= 0.05; y += 0.01) {
        const Eigen::Vector2d place = node.center_m + Eigen::Vector2d(x, y);
        if ((place - node.center_m).norm() > target.circle_radius_m) continue;
        EXPECT_EQ(shift.shown_at(place), place);
      }
    }
  }
  const Eigen::Vector2d outside(-0.05, 0.3);
  EXPECT_EQ(shift.shown_at(outside), outside);
}

TEST(CornerShift, NeedsTagsAndAValue) {
  Target board;
  EXPECT_FALSE(CornerShift(board, 0.0, askew).active());
  board.type = TargetType::kCheckerboard;
  EXPECT_FALSE(CornerShift(board, 1.0, askew).active());
}

}  // namespace
}  // namespace lvcalib::simulation
