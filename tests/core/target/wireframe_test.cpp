// SPDX-License-Identifier: GPL-3.0-or-later
#include "target/wireframe.h"

#include <gtest/gtest.h>

namespace lvcalib {
namespace {

TEST(Wireframe, LinesLieWhereThePrintIs) {
  const Target target;
  const Rigid3 pose{so3_exp({0.3, -0.2, 1.0}), {3.0, 1.0, -0.5}};
  const BoardWireframe wire = board_wireframe(target, pose, 24);
  ASSERT_EQ(wire.tags.size(), 16U);
  ASSERT_EQ(wire.circles.size(), 9U);
  EXPECT_EQ(wire.outline_m.size(), 4U * 24U);
  for (const auto& circle : wire.circles) {
    ASSERT_EQ(circle.points_m.size(), 24U);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : circle.points_m) mean += p / 24.0;
    const TargetNode node = target.nodes()[static_cast<std::size_t>(circle.id)];
    const Eigen::Vector3d center(node.center_m.x(), node.center_m.y(), 0.0);
    EXPECT_LT((mean - pose * center).norm(), 1e-12);
    for (const Eigen::Vector3d& p : circle.points_m) {
      const Eigen::Vector3d on_board = pose.inverse() * p;
      EXPECT_NEAR((on_board - center).norm(), target.circle_radius_m, 1e-12);
      EXPECT_NEAR(on_board.z(), 0.0, 1e-12);
    }
  }
  const auto corners = target.tag_corners_m(target.tags()[5]);
  EXPECT_EQ(wire.tags[5].id, target.tags()[5].id);
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector3d p(corners[k].x(), corners[k].y(), 0.0);
    EXPECT_LT((wire.tags[5].points_m[k] - pose * p).norm(), 1e-12);
  }
}

TEST(Wireframe, CheckerboardHasAnOutlineOnly) {
  Target target;
  target.type = TargetType::kCheckerboard;
  target.corner_columns = 7;
  target.corner_rows = 5;
  target.column_spacing_m = target.row_spacing_m = 0.1;
  target.board_width_m = 1.0;
  target.board_height_m = 0.8;
  const BoardWireframe wire = board_wireframe(target, Rigid3{}, 2);
  EXPECT_TRUE(wire.tags.empty());
  EXPECT_TRUE(wire.circles.empty());
  ASSERT_EQ(wire.outline_m.size(), 8U);
  EXPECT_NEAR((wire.outline_m[0] - wire.outline_m[2]).norm(), 1.0, 1e-12);
}

}  // namespace
}  // namespace lvcalib
