// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/board_placement.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "simulation/rig.h"

namespace lvcalib::simulation {
namespace {

struct Setting {
  SimulationOptions options;
  Camera camera = random_camera(options.image, Random(1));
  Rigid3 camera_from_lidar = random_mount(Random(2));

  [[nodiscard]] ScanPattern pattern() const { return ScanPattern(options.lidar, Random(3)); }
  [[nodiscard]] Result<Rigid3> place(int scene, std::uint64_t seed = 4) const {
    return place_board(options, camera, camera_from_lidar, pattern(), scene, Random(seed));
  }
  [[nodiscard]] double share_in_field(const Rigid3& lidar_from_board) const {
    const auto points = outline_points(options.target, 21);
    int inside = 0;
    for (const auto& p : points) inside += pattern().in_field(lidar_from_board * p) ? 1 : 0;
    return static_cast<double>(inside) / static_cast<double>(points.size());
  }
};

TEST(PlaceBoard, IsInTheImageInTheFieldAtTheDistanceAndFacesTheRig) {
  const Setting setting;
  for (int scene = 0; scene < 20; ++scene) {
    const auto placed = setting.place(scene, static_cast<std::uint64_t>(scene));
    ASSERT_TRUE(placed.ok());
    for (const auto& point : outline_points(setting.options.target, 5)) {
      const auto pixel = setting.camera.project(setting.camera_from_lidar * (*placed * point));
      ASSERT_TRUE(pixel && setting.camera.in_image(*pixel));
    }
    EXPECT_EQ(setting.share_in_field(*placed), 1.0);
    const Eigen::Vector2d c = setting.options.target.outline().center_m();
    const Eigen::Vector3d center = *placed * Eigen::Vector3d(c.x(), c.y(), 0.0);
    EXPECT_GE(center.norm(), 2.0 - 1e-9);
    EXPECT_LE(center.norm(), 4.0 + 1e-9);
    const Eigen::Vector3d normal = placed->rotation * Eigen::Vector3d::UnitZ();
    const double tilt = std::acos(-normal.dot(center.normalized())) * 180.0 / std::numbers::pi;
    EXPECT_LE(tilt, 35.0 + 1e-9);
    EXPECT_GE(tilt, scene > 0 ? 17.0 : 0.0);
    // Upright within the roll, and read from the front.
    EXPECT_GT((placed->rotation * Eigen::Vector3d::UnitY()).z(), 0.5);
  }
}

TEST(PlaceBoard, PartialLeavesPartOutside) {
  Setting setting;
  setting.options.placement.partial = true;
  for (const auto kind : {LidarKind::kRosette, LidarKind::kAvia, LidarKind::kSpinning}) {
    setting.options.lidar.kind = kind;
    const auto placed = setting.place(0);
    ASSERT_TRUE(placed.ok()) << placed.error().text();
    EXPECT_GT(setting.share_in_field(*placed), 0.4);
    EXPECT_LT(setting.share_in_field(*placed), 0.95);
  }
}

TEST(PlaceBoard, SaysWhenTheBoardFitsNowhere) {
  Setting setting;
  setting.options.placement.min_distance_m = 0.5;
  setting.options.placement.max_distance_m = 0.6;
  const auto placed = setting.place(0);
  ASSERT_FALSE(placed.ok());
  EXPECT_EQ(placed.error().kind, ErrorKind::kUsage);
}

}  // namespace
}  // namespace lvcalib::simulation
