// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud/local_normals.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/panel_clouds.h"

namespace lvcalib {
namespace {

TEST(LocalNormals, OfANoisyPanelPointToTheLidar) {
  Random random(3);
  Cloud cloud;
  const Rigid3 pose = test::upright(3.0, 0.4, 0.1, 0.6);
  test::add_panel(cloud, pose, {1.0, 0.8}, 20'000, 0.008, random);
  const Eigen::Vector3d truth = pose.rotation * Eigen::Vector3d::UnitZ();
  const auto normals = local_normals(cloud, {}, {});
  ASSERT_EQ(normals.size(), cloud.size());
  std::size_t known = 0;
  double squares = 0.0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (normals[i].isZero()) continue;
    ++known;
    EXPECT_LT(normals[i].dot(cloud.points_m[i]), 0.0F);
    squares += 1.0 - std::pow(normals[i].cast<double>().dot(truth), 2);
  }
  EXPECT_GT(known, cloud.size() * 9 / 10);
  // 8 mm over patches 15 cm wide with a hundred points and more.
  EXPECT_LT(std::sqrt(squares / static_cast<double>(known)), 0.05);
}

TEST(LocalNormals, AreZeroWhereNothingIsFlat) {
  Random random(4);
  Cloud cloud;
  for (int i = 0; i < 2000; ++i) {
    cloud.points_m.push_back({2.0F + static_cast<float>(random.uniform(0, 0.1)),
                              static_cast<float>(random.uniform(0, 0.1)),
                              static_cast<float>(random.uniform(0, 0.1))});
  }
  cloud.points_m.push_back({5.0F, 5.0F, 5.0F});
  cloud.points_m.push_back({0.0F, 0.0F, 0.0F});
  cloud.points_m.push_back({std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F});
  cloud.points_m.push_back({1e30F, 0.0F, 0.0F});
  std::size_t flat = 0;
  const auto normals = local_normals(cloud, {}, {});
  for (const auto& n : normals) flat += n.isZero() ? 0 : 1;
  EXPECT_LT(flat, 50U);
  for (std::size_t i = cloud.size() - 4; i < cloud.size(); ++i) EXPECT_TRUE(normals[i].isZero());
}

TEST(LocalNormals, StopWhenAsked) {
  Cloud cloud;
  cloud.points_m.assign(10, {1.0F, 0.0F, 0.0F});
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  EXPECT_TRUE(local_normals(cloud, {}, context).empty());
}

}  // namespace
}  // namespace lvcalib
