// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/print_match.h"

#include <cmath>
#include <stop_token>

#include <gtest/gtest.h>

#include "forward_rig.h"
#include "support/ordinary_boards.h"

namespace lvcalib {
namespace {

simulation::SimulationOptions match_options(std::uint64_t seed, int scenes = 1) {
  auto o = test::cloud_only_options(seed, simulation::LidarKind::kAvia);
  o.scenes = scenes;
  o.target.tag_spacing = 0.1 / 0.12;
  return o;
}

BeamSpread spot() {
  BeamSpread b;
  b.blur_rad2 = 1.5e-6 * Eigen::Matrix2d::Identity();
  return b;
}

// The returns of all scenes where an extrinsic puts the boards.
std::vector<BoardReturns> returns_of(const test::ForwardRig& rig, const BlurredPrint& print,
                                     const Rigid3& camera_from_lidar) {
  std::vector<BoardReturns> out;
  for (std::size_t s = 0; s < rig.scenes.size(); ++s) {
    const Rigid3 board = camera_from_lidar.inverse() * rig.scenes[s].camera_from_board;
    out.push_back(select_returns(rig.clouds[s], print, board, spot(), {0.016, 0.016}));
  }
  return out;
}

std::vector<Rigid3> boards_of(const test::ForwardRig& rig) {
  std::vector<Rigid3> out;
  for (const ForwardScene& scene : rig.scenes) out.push_back(scene.camera_from_board);
  return out;
}

TEST(PrintMatch, ThePrintFindsItsPlace) {
  const auto rig = test::forward_rig(match_options(4));
  const BlurredPrint print(rig.target);
  const Rigid3& truth = rig.lidar_from_board.front();
  const Eigen::Vector2d c = rig.target.outline().center_m();
  const Eigen::Vector3d center(c.x(), c.y(), 0.0);
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const Rigid3 start = test::off_by(truth, rig.target, 0.06, 0.0, seed);
    // Turned about the normal by five degrees as well.
    const Eigen::Quaterniond spin = so3_exp({0.0, 0.0, seed % 2 == 0 ? 0.087 : -0.087});
    const Rigid3 turned = start * Rigid3{spin, center - spin * center};
    const BoardReturns returns =
        select_returns(rig.clouds.front(), print, turned, spot(), {0.016, 0.016});
    const auto matches = match_print(returns, print, turned);
    ASSERT_FALSE(matches.empty());
    const PrintMatch& match = matches.front();
    EXPECT_LT((match.lidar_from_board * center - truth * center).norm(), 0.004);
    EXPECT_LT(rotation_distance_rad(match.lidar_from_board, truth), 0.008);
    EXPECT_GT(match.correlation, 0.9);
    for (std::size_t k = 1; k < matches.size(); ++k) {
      EXPECT_GT(match.log_likelihood, matches[k].log_likelihood + 100.0);
      EXPECT_GE((matches[k].lidar_from_board * center - match.lidar_from_board * center).norm(),
                kOtherPlace_m);
    }
  }
}

TEST(PrintMatch, APlainBoardMatchesNothing) {
  auto rig = test::forward_rig(match_options(5));
  Random random(1);
  for (float& i : rig.clouds.front().intensity)
    i = static_cast<float>(100.0 + 5.0 * random.normal());
  const BlurredPrint print(rig.target);
  const Rigid3& truth = rig.lidar_from_board.front();
  const BoardReturns returns =
      select_returns(rig.clouds.front(), print, truth, spot(), {0.016, 0.016});
  EXPECT_TRUE(match_print(returns, print, truth).empty());
  EXPECT_NEAR(intensity_structure(returns), 1.0, 0.1);
}

// A window of one square in a checkerboard looks the same two squares on; the whole board does not.
TEST(PrintMatch, WhatLooksTheSameElsewhereIsFoundThereToo) {
  auto o = match_options(6);
  o.target = test::checkerboard_target();
  o.target.column_spacing_m = o.target.row_spacing_m = 0.03;
  o.target.corner_columns = 25;
  o.target.corner_rows = 19;
  const auto rig = test::forward_rig(o);
  const BlurredPrint print(rig.target);
  const Rigid3& truth = rig.lidar_from_board.front();
  const Rigid3 board_from_lidar = truth.inverse();
  const Eigen::Vector2d c = rig.target.outline().center_m();
  Cloud window;
  const Cloud& cloud = rig.clouds.front();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = board_from_lidar * cloud.points_m[i].cast<double>().eval();
    if ((p.head<2>() - c).cwiseAbs().maxCoeff() < 0.15) append_point(window, cloud, i);
  }
  const auto returns = select_returns(window, print, truth, spot(), {0.016, 0.016});
  const auto matches = match_print(returns, print, truth);
  ASSERT_GT(matches.size(), 1U);
  EXPECT_LT(matches[0].log_likelihood - matches[1].log_likelihood, 10.0);
}

// From a start that is off by two squares and more all scenes' prints lead to one extrinsic; a
// scene without a print has no say in it and is told.
TEST(PrintMatch, PrintsOfAllScenesVoteForOneExtrinsic) {
  auto rig = test::forward_rig(match_options(21, 3));
  Random random(2);
  for (float& i : rig.clouds.back().intensity)
    i = static_cast<float>(100.0 + 5.0 * random.normal());
  const BlurredPrint print(rig.target);
  Vector6d off;
  // Planes hold what a print does not: the boards face the camera more or less.
  off << 0.05, -0.04, 0.0, 0.0, 0.0, 0.0;
  const Rigid3 start = rig.start(off);
  const auto vote =
      vote_on_print(returns_of(rig, print, start), print, boards_of(rig), start, {}, {});
  ASSERT_TRUE(vote);
  const Eigen::Vector2d c = rig.target.outline().center_m();
  for (const ForwardScene& scene : rig.scenes) {
    const Eigen::Vector3d middle = scene.camera_from_board * Eigen::Vector3d(c.x(), c.y(), 0.0);
    const Eigen::Vector3d before = start.inverse() * middle;
    const Eigen::Vector3d after = vote->camera_from_lidar.inverse() * middle;
    const Eigen::Vector3d truth = rig.camera_from_lidar.inverse() * middle;
    EXPECT_GT((before - truth).norm(), kOtherPlace_m);
    EXPECT_LT((after - truth).norm(), 0.5 * kOtherPlace_m);
  }
  EXPECT_GT(vote->margin, 100.0);
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_FALSE(vote->scenes[s].unseen);
    EXPECT_GT(vote->scenes[s].correlation, 0.9);
    EXPECT_GT(vote->scenes[s].margin, 100.0);
  }
  EXPECT_TRUE(vote->scenes[2].unseen);
  EXPECT_EQ(vote->scenes[2].correlation, 0.0);
}

// A print that lies beyond what its own search tries is found where the other scenes put it.
TEST(PrintMatch, APrintBeyondItsOwnSearchIsSeenWhereTheOthersPutIt) {
  const auto rig = test::forward_rig(match_options(22, 2));
  const BlurredPrint print(rig.target);
  std::vector<BoardReturns> returns = returns_of(rig, print, rig.camera_from_lidar);
  // Too few of one scene's returns for a search; enough to see the print where it is.
  returns[1].index.resize(25);
  returns[1].successor.resize(25);
  const auto vote = vote_on_print(returns, print, boards_of(rig), rig.camera_from_lidar, {}, {});
  ASSERT_TRUE(vote);
  EXPECT_FALSE(vote->scenes[1].unseen);
  EXPECT_GT(vote->scenes[1].correlation, 0.3);
  EXPECT_EQ(vote->scenes[1].margin, 0.0);
}

TEST(PrintMatch, StopsWhenAsked) {
  const auto rig = test::forward_rig(match_options(23));
  const BlurredPrint print(rig.target);
  const auto returns = returns_of(rig, print, rig.camera_from_lidar);
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  EXPECT_FALSE(vote_on_print(returns, print, boards_of(rig), rig.camera_from_lidar, {}, context));
}

}  // namespace
}  // namespace lvcalib
