// SPDX-License-Identifier: GPL-3.0-or-later
#include "localization/voxel_cloud.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "base/random.h"

namespace lvcalib {
namespace {

Cloud random_cloud(int count, double half_m, std::uint64_t seed) {
  Random random(seed);
  Cloud cloud;
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(-half_m, half_m);
    const double y = random.uniform(-half_m, half_m);
    const double z = random.uniform(-half_m, half_m);
    cloud.points_m.emplace_back(Eigen::Vector3d(x, y, z).cast<float>());
    cloud.intensity.push_back(static_cast<float>(random.uniform(0.0, 200.0)));
  }
  return cloud;
}

VoxelCloud::Options options(double voxel_m) {
  VoxelCloud::Options o;
  o.voxel_m = voxel_m;
  o.min_range_m = 0.0;
  return o;
}

TEST(VoxelCloud, HoldsMeansAndCountsOfEveryVoxel) {
  const Cloud cloud = random_cloud(20'000, 1.0, 1);
  const VoxelCloud voxels(cloud, options(0.125), {});
  struct Sum {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    double intensity = 0.0;
    std::uint32_t count = 0;
  };
  std::map<std::array<int, 3>, Sum> expected;
  const auto key = [](const Eigen::Vector3f& p) {
    return std::array<int, 3>{static_cast<int>(std::floor(p.x() * 8)),
                              static_cast<int>(std::floor(p.y() * 8)),
                              static_cast<int>(std::floor(p.z() * 8))};
  };
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    Sum& sum = expected[key(cloud.points_m[i])];
    sum.point += cloud.points_m[i].cast<double>();
    sum.intensity += cloud.intensity[i];
    ++sum.count;
  }
  ASSERT_EQ(voxels.voxels().size(), expected.size());
  for (const VoxelCloud::Voxel& voxel : voxels.voxels()) {
    const Sum& sum = expected.at(key(voxel.mean_m));
    EXPECT_EQ(voxel.count, sum.count);
    EXPECT_LT((voxel.mean_m.cast<double>() - sum.point / sum.count).norm(), 1e-5);
    EXPECT_NEAR(voxel.mean_intensity, sum.intensity / sum.count, 1e-2);
  }
}

TEST(VoxelCloud, NeighboursAreThoseOfABruteForceSearch) {
  const VoxelCloud voxels(random_cloud(5'000, 1.5, 2), options(0.05), {});
  Random random(3);
  std::vector<std::uint32_t> found;
  for (int query = 0; query < 200; ++query) {
    Eigen::Vector3f at;
    for (float& v : at) v = static_cast<float>(random.uniform(-1.6, 1.6));
    // Every third query on a corner of the coarse grid, where rounding may go either way.
    if (query % 3 == 0) {
      for (float& v : at) v = 0.3F * std::round(v / 0.3F);
    }
    const double radius = random.uniform(0.05, 0.7);
    voxels.neighbours(at, radius, found);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < voxels.voxels().size(); ++i) {
      if ((voxels.voxels()[i].mean_m - at).norm() <= static_cast<float>(radius))
        expected.push_back(i);
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected) << "query " << at.transpose() << ", radius " << radius;
  }
}

TEST(VoxelCloud, OneRepresentativeStandsForEachCell) {
  const VoxelCloud voxels(random_cloud(5'000, 1.5, 4), options(0.05), {});
  const auto representatives = voxels.cell_representatives();
  std::set<std::array<int, 3>> cells;
  const auto cell = [](const Eigen::Vector3f& p) {
    return std::array<int, 3>{static_cast<int>(std::floor(p.x() / 0.3F)),
                              static_cast<int>(std::floor(p.y() / 0.3F)),
                              static_cast<int>(std::floor(p.z() / 0.3F))};
  };
  for (const auto& voxel : voxels.voxels()) cells.insert(cell(voxel.mean_m));
  EXPECT_EQ(representatives.size(), cells.size());
  for (const std::uint32_t i : representatives)
    EXPECT_EQ(cells.erase(cell(voxels.voxels()[i].mean_m)), 1U);
  EXPECT_TRUE(std::is_sorted(representatives.begin(), representatives.end()));
}

TEST(VoxelCloud, RangeAndRegionGatesLeaveOutPoints) {
  const Cloud cloud = random_cloud(10'000, 2.0, 5);
  VoxelCloud::Options gates = options(0.01);
  gates.min_range_m = 0.5;
  gates.max_range_m = 1.5;
  gates.region_center_m = {1.0, 0.0, 0.0};
  gates.region_radius_m = 0.8;
  const VoxelCloud voxels(cloud, gates, {});
  std::uint32_t kept = 0;
  for (const auto& voxel : voxels.voxels()) kept += voxel.count;
  std::uint32_t expected = 0;
  for (const Eigen::Vector3f& p : cloud.points_m) {
    expected +=
        p.norm() >= 0.5F && p.norm() <= 1.5F && (p - Eigen::Vector3f(1, 0, 0)).norm() <= 0.8F;
  }
  EXPECT_EQ(kept, expected);
  EXPECT_GT(kept, 100U);
}

TEST(VoxelCloud, OddInputIsTakenCalmly) {
  const VoxelCloud empty(Cloud{}, options(0.02), {});
  EXPECT_TRUE(empty.voxels().empty());
  EXPECT_TRUE(empty.cell_representatives().empty());
  std::vector<std::uint32_t> found{1, 2};
  empty.neighbours({0, 0, 0}, 1.0, found);
  EXPECT_TRUE(found.empty());
  Cloud odd;
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  odd.points_m = {{kNan, 0, 0},
                  {1e30F, 0, 0},
                  {0, -std::numeric_limits<float>::infinity(), 0},
                  {1.0F, 1.0F, 1.0F}};
  const VoxelCloud voxels(odd, options(0.02), {});
  ASSERT_EQ(voxels.voxels().size(), 1U);
  EXPECT_EQ(voxels.voxels()[0].mean_m, Eigen::Vector3f(1, 1, 1));
  EXPECT_EQ(voxels.voxels()[0].mean_intensity, 0.0F);
}

TEST(VoxelCloud, StopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  EXPECT_TRUE(VoxelCloud(random_cloud(1000, 1.0, 6), options(0.02), context).voxels().empty());
}

}  // namespace
}  // namespace lvcalib
