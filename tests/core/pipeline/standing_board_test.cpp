// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/standing_board.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "support/ordinary_boards.h"

namespace lvcalib {
namespace {

const Rigid3 kBoard = se3_exp((Vector6d() << 3.0, 0.2, -0.3, 0.2, -1.3, 0.1).finished());

// A lattice of returns in the board's plane, about its middle, with a centimetre of noise along it.
Cloud flat(const Target& target, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m,
           double step_m = 0.03) {
  Random random(1);
  Cloud cloud;
  const Eigen::Vector2d c = target.outline().center_m();
  for (double x = from_m.x(); x <= to_m.x(); x += step_m) {
    for (double y = from_m.y(); y <= to_m.y(); y += step_m)
      cloud.points_m.push_back(
          (kBoard * Eigen::Vector3d(c.x() + x, c.y() + y, 0.005 * random.normal())).cast<float>());
  }
  return cloud;
}

// Where image and other scenes put it: two centimetres and a degree off.
Rigid3 predicted() {
  return se3_exp((Vector6d() << 0.015, -0.01, 0.01, 0.01, 0.0, -0.015).finished()) * kBoard;
}

TEST(StandingBoard, IsFoundWhereAWholeOrHalfOfItIsSeen) {
  const Target target = test::checkerboard_target();
  const Eigen::Vector2d half = 0.5 * target.outline().size_m();
  for (const double seen : {1.0, 0.0}) {
    const auto found = find_standing_board(
        flat(target, -half, Eigen::Vector2d(half.x(), seen * half.y())), target, predicted());
    ASSERT_TRUE(found) << seen;
    ASSERT_EQ(found->candidates.size(), 1U);
    ASSERT_EQ(found->patch_points.size(), 1U);
    const Rigid3& board = found->candidates[0].lidar_from_board.transform;
    const Eigen::Vector3d normal = board.rotation * Eigen::Vector3d::UnitZ();
    EXPECT_GT(normal.dot(kBoard.rotation * Eigen::Vector3d::UnitZ()), std::cos(0.004));
    EXPECT_LT(std::abs((kBoard.inverse() * board.translation).z()), 0.005);
  }
}

TEST(StandingBoard, IsNoWallAndNothingRoundNorFarOffNorFaint) {
  const Target target = test::checkerboard_target();
  const Eigen::Vector2d half = 0.5 * target.outline().size_m();
  const Eigen::Vector2d wide = half.array() + 0.5;
  EXPECT_FALSE(find_standing_board(flat(target, -wide, wide), target, predicted()));
  EXPECT_FALSE(find_standing_board(flat(target, -half, half, 0.2), target, predicted()));
  const Rigid3 behind = predicted() * Rigid3{Eigen::Quaterniond::Identity(), {0.0, 0.0, 0.08}};
  EXPECT_FALSE(find_standing_board(flat(target, -half, half), target, behind));
  Cloud round = flat(target, -half, half);
  for (Eigen::Vector3f& p : round.points_m) {
    Eigen::Vector3d at = kBoard.inverse() * p.cast<double>();
    at.z() += 0.08 * std::cos(9.0 * at.x());
    p = (kBoard * at).cast<float>();
  }
  EXPECT_FALSE(find_standing_board(round, target, predicted()));
  EXPECT_FALSE(find_standing_board({}, target, predicted()));
}

}  // namespace
}  // namespace lvcalib
