// SPDX-License-Identifier: GPL-3.0-or-later
#include "target/target.h"

#include <gtest/gtest.h>

namespace lvcalib {
namespace {

TEST(Target, NodesSitInTheMiddleOfGapCrossings) {
  Target target;
  target.tag_spacing = 0.1 / 0.12;
  const auto nodes = target.nodes();
  ASSERT_EQ(nodes.size(), 9U);
  EXPECT_NEAR(nodes[0].center_m.x(), 0.17, 1e-12);
  EXPECT_EQ(nodes[5].id, 5);
  EXPECT_NEAR(nodes[5].center_m.x(), 0.17 + 2 * 0.22, 1e-12);
  EXPECT_NEAR(nodes[5].center_m.y(), 0.17 + 0.22, 1e-12);
}

TEST(Target, AlbedoIsBlackInCirclesAndBordersAndWhiteInGaps) {
  const Target target;
  for (const TargetNode& node : target.nodes()) {
    EXPECT_EQ(target.albedo(node.center_m), 0.0);
    EXPECT_EQ(target.albedo(node.center_m + Eigen::Vector2d(0.046, 0.0)), 1.0);
  }
  EXPECT_EQ(target.albedo({0.005, 0.06}), 0.0);   // border of tag 0
  EXPECT_EQ(target.albedo({-0.03, -0.03}), 1.0);  // margin
  EXPECT_FALSE(target.albedo({-0.061, 0.0}).has_value());
}

TEST(Target, TagBitsFollowTheFamilyUpright) {
  Target target;
  const double bit = target.tag_bit_m();
  EXPECT_NEAR(bit, 0.015, 1e-12);
  const TagPattern* pattern = tag_pattern("tag36h11", 3);
  ASSERT_NE(pattern, nullptr);
  const TargetTag tag = *target.tag(3);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      const Eigen::Vector2d p = tag.center_m + bit * Eigen::Vector2d(column - 2.5, 2.5 - row);
      EXPECT_EQ(*target.albedo(p) > 0.5, pattern->at(row, column)) << row << "," << column;
    }
  }
  target.tag_border_bits = 2;
  EXPECT_NEAR(target.tag_bit_m(), 0.012, 1e-12);
  EXPECT_EQ(target.albedo({0.02, 0.06}), 0.0);  // second ring of the border
}

TEST(Target, RefusesCirclesThatRunIntoTags) {
  Target target;
  target.circle_radius_m = 0.071;
  EXPECT_FALSE(check(target).ok());
  target.circle_radius_m = 0.07;
  EXPECT_TRUE(check(target).ok());
}

}  // namespace
}  // namespace lvcalib
