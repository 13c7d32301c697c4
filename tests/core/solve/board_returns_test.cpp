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

TEST(BoardReturns, HalfABoardIsSeenAsHalf) {
  auto rig = test::forward_rig(options(11));
  const BlurredPrint print(rig.target);
  const Rigid3& truth = rig.lidar_from_board.front();
  const Rigid3 board_from_lidar = truth.inverse();
  const double middle = rig.target.outline().center_m().x();
  const auto seen = [&](const Cloud& cloud) {
    return seen_share(select_returns(cloud, print, truth, beam(), {0.016, 0.016}), print, truth);
  };
  EXPECT_GE(seen(rig.clouds.front()), 0.9);
  Cloud left;
  for (std::size_t i = 0; i < rig.clouds.front().size(); ++i) {
    const Eigen::Vector3d p = rig.clouds.front().points_m[i].cast<double>();
    if ((board_from_lidar * p).x() < middle) append_point(left, rig.clouds.front(), i);
  }
  EXPECT_NEAR(seen(left), 0.5, 0.07);
}

}  // namespace
}  // namespace lvcalib
