// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/point_picking.h"

#include <vector>

#include <gtest/gtest.h>

namespace lvcalib::widgets::point_picking_test {
namespace {

// A viewer at the origin looking along −z, 90° wide, as OpenGL has it.
Eigen::Matrix4d perspective() {
  const double near = 0.1;
  const double far = 100.0;
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  m(0, 0) = m(1, 1) = 1.0;
  m(2, 2) = -(far + near) / (far - near);
  m(2, 3) = -2.0 * far * near / (far - near);
  m(3, 2) = -1.0;
  return m;
}

const Eigen::Vector2d kViewport(200, 200);

TEST(PointPicking, TheNearestUnderTheCursor) {
  // Two on one line of sight, one to the right, one behind the viewer.
  const std::vector<float> xyz{0, 0, -5, 0, 0, -2, 1, 0, -2, 0, 0, 2};
  EXPECT_EQ(pick_point(xyz, perspective(), kViewport, {100, 100}, 5.0), 1U);
  EXPECT_EQ(pick_point(xyz, perspective(), kViewport, {152, 99}, 5.0), 2U);
  EXPECT_FALSE(pick_point(xyz, perspective(), kViewport, {20, 20}, 5.0));
  EXPECT_FALSE(pick_point({}, perspective(), kViewport, {100, 100}, 5.0));
}

TEST(PointPicking, AtTheSameDepthTheOneNearerToTheCursor) {
  const std::vector<float> xyz{0, 0, -2, 0.06F, 0, -2};
  EXPECT_EQ(pick_point(xyz, perspective(), kViewport, {102.5, 100}, 6.0), 1U);
  EXPECT_EQ(pick_point(xyz, perspective(), kViewport, {100.5, 100}, 6.0), 0U);
}

TEST(PointPicking, UpIsUp) {
  const std::vector<float> xyz{0, 1, -2, 0, -1, -2};
  EXPECT_EQ(pick_point(xyz, perspective(), kViewport, {100, 50}, 5.0), 0U);
}

}  // namespace
}  // namespace lvcalib::widgets::point_picking_test
