// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/rig.h"

#include <gtest/gtest.h>

namespace lvcalib::simulation {
namespace {

TEST(Rig, CameraFileReadsBackAsTheSameCamera) {
  for (const auto model : {DistortionModel::kPlumbBob, DistortionModel::kRationalPolynomial,
                           DistortionModel::kEquidistant}) {
    ImageOptions options;
    options.distortion = model;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const Camera camera = random_camera(options, Random(seed));
      ASSERT_TRUE(check(camera).ok());
      EXPECT_EQ(camera.model, model);
      EXPECT_EQ(camera.width_px, 1440);
      // Every pixel has a ray that projects back.
      for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(0, 0), Eigen::Vector2d(1439, 899)}) {
        const auto ray = camera.unproject(pixel);
        ASSERT_TRUE(ray.has_value()) << seed;
        const auto back = camera.project(*ray);
        ASSERT_TRUE(back.has_value());
        EXPECT_LT((*back - pixel).norm(), 1e-6);
      }
    }
  }
}

TEST(Rig, MountLooksAheadFromNearby) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Rigid3 camera_from_lidar = random_mount(Random(seed));
    EXPECT_LT(camera_from_lidar.translation.norm(), 0.3);
    const Eigen::Vector3d ahead = camera_from_lidar.rotation * Eigen::Vector3d::UnitX();
    EXPECT_GT(ahead.z(), 0.95);
    const Eigen::Vector3d up = camera_from_lidar.rotation * Eigen::Vector3d::UnitZ();
    EXPECT_LT(up.y(), -0.95);
  }
}

}  // namespace
}  // namespace lvcalib::simulation
