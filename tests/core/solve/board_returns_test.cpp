// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/board_returns.h"

#include <cmath>

#include <gtest/gtest.h>

#include "forward_rig.h"
#include "support/ordinary_boards.h"

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
      select_returns(cloud, print, rig.lidar_from_board.front(), beam(), {0.016, 0.016});
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

// A post 20 cm before the board of which the crop about the board has only the spots that are
// partly on it: too near by less than single returns on black print may be.
TEST(BoardReturns, WhatHidesTheBoardInPartIsLeftOut) {
  auto rig = test::forward_rig(options(8));
  const BlurredPrint print(rig.target);
  const Rigid3& truth = rig.lidar_from_board.front();
  const Rigid3 board_from_lidar = truth.inverse();
  const Eigen::Vector2d c = rig.target.outline().center_m();
  constexpr double kHalfPost_m = 0.015;
  constexpr double kSpot_m = 0.004;
  const auto from_post = [&](const Eigen::Vector3f& p) {
    const Eigen::Vector3d at = board_from_lidar * p.cast<double>().eval();
    return std::hypot(std::max(0.0, at.y() - c.y()),
                      std::max(0.0, std::abs(at.x() - c.x()) - kHalfPost_m));
  };
  const auto on_post = [&](double d) {
    return 0.5 * std::erfc((d > 0.0 ? d : -1.0) / (kSpot_m * std::sqrt(2.0)));
  };
  Cloud cloud;
  std::vector<double> hidden;  // Share of each return's light that comes from the post.
  for (std::size_t i = 0; i < rig.clouds.front().size(); ++i) {
    const Eigen::Vector3d p = rig.clouds.front().points_m[i].cast<double>();
    const double share = on_post(from_post(rig.clouds.front().points_m[i]));
    if (0.2 * share > 0.08) continue;
    append_point(cloud, rig.clouds.front(), i);
    cloud.points_m.back() = ((p.norm() - 0.2 * share) * p.normalized()).cast<float>();
    hidden.push_back(share);
  }
  const RangeNoise noise{0.008, 0.016};
  const BoardReturns returns = select_returns(cloud, print, truth, beam(), noise);
  std::size_t touched = 0;
  std::size_t left = 0;
  for (const double share : hidden) touched += share > 0.01 ? 1 : 0;
  for (const std::uint32_t i : returns.index) left += hidden[i] > 0.01 ? 1 : 0;
  ASSERT_GT(touched, 50U);
  // But for places where the scan has too few of them to stand together.
  EXPECT_LT(8 * left, touched);
  // What is left out is there, not all over the board.
  std::size_t far = 0;
  for (const std::uint32_t i : returns.index) far += from_post(cloud.points_m[i]) > 0.08 ? 1 : 0;
  std::size_t all_far = 0;
  ReturnSelection open;
  open.covers = false;
  for (const std::uint32_t i : select_returns(cloud, print, truth, beam(), noise, open).index)
    all_far += from_post(cloud.points_m[i]) > 0.08 ? 1 : 0;
  EXPECT_EQ(far, all_far);
}

// Errors that come now and then everywhere are no post.
TEST(BoardReturns, OutliersAllOverTheBoardHideNothing) {
  auto rig = test::forward_rig(options(9));
  const BlurredPrint print(rig.target);
  Cloud& cloud = rig.clouds.front();
  Random random(4);
  for (Eigen::Vector3f& p : cloud.points_m) {
    if (random.uniform() > 0.005) continue;
    p *= static_cast<float>(1.0 - random.uniform(0.035, 0.07) / static_cast<double>(p.norm()));
  }
  const BoardReturns returns =
      select_returns(cloud, print, rig.lidar_from_board.front(), beam(), {0.008, 0.016});
  EXPECT_LT(100 * returns.refused, returns.on_board);
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
    const BoardReturns returns =
        select_returns(rig.clouds.front(), print, turned, beam(), {0.016, 0.016});
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

TEST(BoardReturns, APlainBoardMatchesNothing) {
  auto rig = test::forward_rig(options(5));
  Random random(1);
  for (float& i : rig.clouds.front().intensity)
    i = static_cast<float>(100.0 + 5.0 * random.normal());
  const BlurredPrint print(rig.target);
  const Rigid3& truth = rig.lidar_from_board.front();
  const BoardReturns returns =
      select_returns(rig.clouds.front(), print, truth, beam(), {0.016, 0.016});
  EXPECT_TRUE(match_print(returns, print, truth).empty());
  EXPECT_NEAR(intensity_structure(returns), 1.0, 0.1);
}

// A window of one square in a checkerboard looks the same two squares on; the whole board does not.
TEST(BoardReturns, WhatLooksTheSameElsewhereIsFoundThereToo) {
  auto o = options(6);
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
  const auto returns = select_returns(window, print, truth, beam(), {0.016, 0.016});
  const auto matches = match_print(returns, print, truth);
  ASSERT_GT(matches.size(), 1U);
  EXPECT_LT(matches[0].log_likelihood - matches[1].log_likelihood, 10.0);
}

TEST(BoardReturns, StepsAndCeilingOfTheIntensityAreSeen) {
  auto rig = test::forward_rig(options(7));
  const BlurredPrint print(rig.target);
  const Rigid3& truth = rig.lidar_from_board.front();
  Cloud& cloud = rig.clouds.front();
  const BoardReturns plain = select_returns(cloud, print, truth, beam(), {0.016, 0.016});
  EXPECT_EQ(plain.saturated, 0.0);
  // Neighbours differ at edges, too; noise alone would give one.
  EXPECT_GT(intensity_structure(plain), 1.4);
  const std::vector<float> intensity = cloud.intensity;
  for (float& i : cloud.intensity) i = 20.0F * std::floor(i / 20.0F);
  EXPECT_EQ(select_returns(cloud, print, truth, beam(), {0.016, 0.016}).intensity_step, 20.0);
  EXPECT_EQ(select_returns(cloud, print, truth, beam(), {0.016, 0.016}).saturated, 0.0);
  cloud.intensity = intensity;
  for (float& i : cloud.intensity) i = std::min(i, 70.0F);
  EXPECT_GT(select_returns(cloud, print, truth, beam(), {0.016, 0.016}).saturated, 0.4);
}

}  // namespace
}  // namespace lvcalib
