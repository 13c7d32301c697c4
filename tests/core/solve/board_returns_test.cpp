// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/board_returns.h"

#include <cmath>

#include <gtest/gtest.h>

#include "forward_rig.h"

namespace lvcalib {
namespace {

simulation::SimulationOptions options(std::uint64_t seed) {
  auto o = test::cloud_only_options(seed, simulation::LidarKind::kAvia);
  o.scenes = 1;
  o.target.tag_spacing = 0.1 / 0.12;
  return o;
}

BeamSpread beam() {
  BeamSpread b;
  b.blur_rad2 = 1.5e-6 * Eigen::Matrix2d::Identity();
  return b;
}

TEST(BoardReturns, AreThoseOnThePlaneAndInsideTheOutline) {
  const auto rig = test::forward_rig(options(3));
  const BlurredPrint print(rig.target);
  const Cloud& cloud = rig.clouds.front();
  const BoardReturns returns =
      select_returns(cloud, print, rig.lidar_from_board.front(), beam(), 0.016);
  EXPECT_GT(returns.size(), cloud.size() / 2);
  EXPECT_LT(100 * returns.refused, returns.on_board);
  EXPECT_TRUE(returns.has_intensity);
  const Rigid3 board_from_lidar = rig.lidar_from_board.front().inverse();
  for (std::size_t k = 0; k < returns.size(); k += 17) {
    const Eigen::Vector3d p = board_from_lidar * returns.point_m(k);
    EXPECT_GT(print.inside_m(p.head<2>()), 0.0);
    EXPECT_LT(std::abs(p.z()), 0.1);
  }
  // Neighbours along a line are of one line, later in the cloud.
  for (std::size_t k = 0; k < returns.size(); ++k) {
    const std::uint32_t next = returns.successor[k];
    if (next == BoardReturns::kNone) continue;
    EXPECT_GT(next, k);
    EXPECT_EQ(cloud.line[returns.index[k]], cloud.line[returns.index[next]]);
  }
}

TEST(BoardReturns, ThePrintFindsItsPlace) {
  const auto rig = test::forward_rig(options(4));
  const BlurredPrint print(rig.target);
  const Rigid3& truth = rig.lidar_from_board.front();
  const Eigen::Vector2d c = rig.target.outline().center_m();
  const Eigen::Vector3d center(c.x(), c.y(), 0.0);
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const Rigid3 start = test::off_by(truth, rig.target, 0.06, 0.0, seed);
    // Turned about the normal by five degrees as well.
    const Eigen::Quaterniond spin = so3_exp({0.0, 0.0, seed % 2 == 0 ? 0.087 : -0.087});
    const Rigid3 turned = start * Rigid3{spin, center - spin * center};
    const BoardReturns returns = select_returns(rig.clouds.front(), print, turned, beam(), 0.016);
    const auto match = match_print(returns, print, turned);
    ASSERT_TRUE(match);
    EXPECT_LT((match->lidar_from_board * center - truth * center).norm(), 0.004);
    EXPECT_LT(rotation_distance_rad(match->lidar_from_board, truth), 0.008);
    EXPECT_GT(match->correlation, 0.9);
    EXPECT_GT(match->margin, 100.0);
  }
}

TEST(BoardReturns, APlainBoardMatchesNothing) {
  auto rig = test::forward_rig(options(5));
  Random random(1);
  for (float& i : rig.clouds.front().intensity)
    i = static_cast<float>(100.0 + 5.0 * random.normal());
  const BlurredPrint print(rig.target);
  const Rigid3& truth = rig.lidar_from_board.front();
  const BoardReturns returns = select_returns(rig.clouds.front(), print, truth, beam(), 0.016);
  EXPECT_FALSE(match_print(returns, print, truth));
}

}  // namespace
}  // namespace lvcalib
