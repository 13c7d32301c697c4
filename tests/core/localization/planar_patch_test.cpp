// SPDX-License-Identifier: GPL-3.0-or-later
#include "localization/planar_patch.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/panel_clouds.h"

namespace lvcalib {
namespace {

constexpr double kDensity = 5000;
constexpr double kNoise = 0.005;

VoxelCloud voxels_of(const Cloud& cloud) {
  VoxelCloud::Options options;
  options.voxel_m = 0.0225;
  options.cell_m = 0.27;
  return {cloud, options, {}};
}

// The patch whose middle lies nearest to a point.
const PlanarPatch* nearest_patch(const std::vector<PlanarPatch>& patches,
                                 const Eigen::Vector3d& point) {
  const PlanarPatch* best = nullptr;
  for (const PlanarPatch& patch : patches) {
    if (patch.open) continue;
    if (best == nullptr || (patch.center_m - point).norm() < (best->center_m - point).norm())
      best = &patch;
  }
  return best;
}

TEST(PlanarPatches, FindABoardAmidARoom) {
  Random random(1);
  Cloud cloud;
  test::add_room(cloud, -1.2, random);
  const Rigid3 board = test::upright(3.0, 0.4, 0.1, 0.5);
  test::add_panel(cloud, board, {0.9, 0.9}, kDensity, kNoise, random);
  const VoxelCloud voxels = voxels_of(cloud);
  const auto patches = find_planar_patches(voxels, {}, {});
  const PlanarPatch* patch = nearest_patch(patches, board.translation);
  ASSERT_NE(patch, nullptr);
  EXPECT_LT((patch->center_m - board.translation).norm(), 0.03);
  EXPECT_GT(patch->normal.dot(board.rotation * Eigen::Vector3d::UnitZ()), std::cos(0.03));
  EXPECT_NEAR(patch->extent_m.x(), 0.9, 0.06);
  EXPECT_NEAR(patch->extent_m.y(), 0.9, 0.06);
  EXPECT_LT(patch->thickness_m, 2.0 * kNoise);
  EXPECT_LT((patch->axis_u.cross(patch->axis_v) - patch->normal).norm(), 1e-9);
  // The walls go on beyond the searched radius.
  const auto open =
      std::count_if(patches.begin(), patches.end(), [](const auto& p) { return p.open; });
  EXPECT_GE(open, 2);
  // Voxels belong to the patch: none farther off than the noise allows.
  for (const std::uint32_t i : patch->voxels) {
    const Eigen::Vector3d d = voxels.voxels()[i].mean_m.cast<double>() - patch->center_m;
    EXPECT_LT(std::abs(patch->normal.dot(d)), 0.06);
  }
}

TEST(PlanarPatches, AreTheSameEveryTime) {
  Random random(2);
  Cloud cloud;
  test::add_room(cloud, -1.2, random);
  test::add_panel(cloud, test::upright(2.5, 0, 0, 0.3), {0.9, 0.9}, kDensity, kNoise, random);
  const VoxelCloud voxels = voxels_of(cloud);
  const auto a = find_planar_patches(voxels, {}, {});
  const auto b = find_planar_patches(voxels, {}, {});
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].voxels, b[k].voxels);
}

// As of 16 lines, 2° apart, at 4 m; what lies farther apart is not one board.
TEST(PlanarPatches, LinesFarApartAreOneBoard) {
  Random random(7);
  const Rigid3 board = test::upright(4.0, 0.4, 0.1, 0.5);
  for (const double step : {0.15, 0.5}) {
    Cloud cloud;
    test::add_room(cloud, -1.2, random);
    for (double y = -0.4; y < 0.4; y += step) {
      const Rigid3 line{board.rotation, board * Eigen::Vector3d(0.0, y, 0.0)};
      test::add_panel(cloud, line, {0.9, 0.002}, 1e5, kNoise, random);
    }
    const auto patches = find_planar_patches(voxels_of(cloud), {}, {});
    const bool whole = std::any_of(patches.begin(), patches.end(), [&](const PlanarPatch& patch) {
      return (patch.center_m - board.translation).norm() < 0.15 && patch.extent_m.y() > 0.7;
    });
    EXPECT_EQ(whole, step < 0.3) << step;
  }
}

TEST(PlanarPatches, StripsWhereTheBoardsPlaneMeetsTheFloorAreCut) {
  Random random(3);
  Cloud cloud;
  test::add_room(cloud, -0.5, random);
  // Standing on the floor: the points of the floor near its plane touch it.
  const Rigid3 board = test::upright(3.0, 0.2, -0.05, 0.4);
  test::add_panel(cloud, board, {0.9, 0.9}, kDensity, kNoise, random);
  const VoxelCloud voxels = voxels_of(cloud);
  PatchSearchOptions options;
  options.connections = {{0.05, true}};
  const auto cut = find_planar_patches(voxels, options, {});
  const PlanarPatch* patch = nearest_patch(cut, board.translation);
  ASSERT_NE(patch, nullptr);
  EXPECT_LT((patch->center_m - board.translation).norm(), 0.06);
  EXPECT_NEAR(patch->extent_m.x(), 0.95, 0.12);
  EXPECT_NEAR(patch->extent_m.y(), 0.9, 0.1);
  // Without the cut the strip ties the board to the floor.
  options.connections = {{0.05, false}};
  const auto whole = find_planar_patches(voxels, options, {});
  for (const PlanarPatch& p : whole) {
    if ((p.center_m - board.translation).norm() > 0.4 ||
        p.normal.dot(board.rotation * Eigen::Vector3d::UnitZ()) < 0.95)
      continue;
    EXPECT_GT(p.extent_m.x(), 1.2);
  }
}

TEST(PlanarPatches, NoiseIsNoPlane) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Random random(seed);
    Cloud cloud;
    for (int i = 0; i < 8000; ++i) {
      Eigen::Vector3d p;
      do {
        for (double& v : p) v = random.uniform(-0.8, 0.8);
      } while (p.norm() > 0.8);
      cloud.points_m.push_back((p + Eigen::Vector3d(3, 0, 0)).cast<float>());
    }
    EXPECT_TRUE(find_planar_patches(voxels_of(cloud), {}, {}).empty()) << "seed " << seed;
  }
}

TEST(PlanarPatches, SmallPlatesAndEdgeOnOnesAreLeftOut) {
  Random random(4);
  Cloud cloud;
  test::add_panel(cloud, test::upright(3.0, 0.0, 0.0, 0.2), {0.25, 0.25}, kDensity, kNoise, random);
  // Its plane passes close by the LiDAR.
  test::add_panel(cloud, test::upright(3.0, 0.15, 0.0, 1.5707963), {0.9, 0.9}, kDensity, kNoise,
                  random);
  EXPECT_TRUE(find_planar_patches(voxels_of(cloud), {}, {}).empty());
}

TEST(PlanarPatches, EmptyAndStoppedGiveNothing) {
  EXPECT_TRUE(find_planar_patches(voxels_of({}), {}, {}).empty());
  Random random(5);
  Cloud cloud;
  test::add_panel(cloud, test::upright(3.0, 0.0, 0.0, 0.2), {0.9, 0.9}, kDensity, kNoise, random);
  const VoxelCloud voxels = voxels_of(cloud);
  EXPECT_FALSE(find_planar_patches(voxels, {}, {}).empty());
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  EXPECT_TRUE(find_planar_patches(voxels, {}, context).empty());
}

TEST(PlaneBasis, IsOrthonormalAndRightHanded) {
  Random random(6);
  for (int i = 0; i < 100; ++i) {
    Eigen::Vector3d normal;
    for (double& v : normal) v = random.normal();
    if (i < 3) normal = Eigen::Vector3d::Unit(i);
    normal.normalize();
    Eigen::Vector3d u;
    Eigen::Vector3d v;
    plane_basis(normal, u, v);
    EXPECT_NEAR(u.norm(), 1.0, 1e-12);
    EXPECT_NEAR(u.dot(normal), 0.0, 1e-12);
    EXPECT_LT((u.cross(v) - normal).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace lvcalib
