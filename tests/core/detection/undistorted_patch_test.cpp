// SPDX-License-Identifier: GPL-3.0-or-later
#include "detection/undistorted_patch.h"

#include <gtest/gtest.h>

#include "support/rendered_board.h"

namespace lvcalib {
namespace {

Camera fisheye() {
  Camera camera = testing::pinhole(1000, 1000, 300);
  camera.model = DistortionModel::kEquidistant;
  camera.distortion.head<4>() << -0.02, 0.01, -0.004, 0.001;
  return camera;
}

TEST(UndistortedPatch, RoundTripIsExactOverATag) {
  for (const Eigen::Vector2d& center : {Eigen::Vector2d(500, 500), Eigen::Vector2d(880, 300)}) {
    const Camera camera = fisheye();
    const auto patch = UndistortedPatch::create(&camera, center, 40.0);
    ASSERT_TRUE(patch.has_value());
    for (double dx = -40; dx <= 40; dx += 16) {
      for (double dy = -40; dy <= 40; dy += 16) {
        const Eigen::Vector2d pixel = center + Eigen::Vector2d(dx, dy);
        const auto back = patch->to_pixel(patch->to_plane(pixel));
        ASSERT_TRUE(back.has_value());
        EXPECT_LT((*back - pixel).norm(), 1e-3);
      }
    }
  }
}

TEST(UndistortedPatch, JacobianEqualsDifferences) {
  const Camera camera = fisheye();
  const Eigen::Vector2d pixel(815, 340);
  const auto patch = UndistortedPatch::create(&camera, {800, 350}, 30.0);
  ASSERT_TRUE(patch.has_value());
  const Eigen::Matrix2d jacobian = patch->plane_by_pixel(pixel);
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = 1e-4 * Eigen::Vector2d::Unit(i);
    const Eigen::Vector2d difference =
        (patch->to_plane(pixel + step) - patch->to_plane(pixel - step)) / 2e-4;
    EXPECT_LT((jacobian.col(i) - difference).norm(), 1e-6);
  }
}

TEST(UndistortedPatch, StraightLinesStayStraight) {
  const Camera camera = fisheye();
  // Points on a straight line in space, close together in the image.
  std::vector<Eigen::Vector2d> pixels;
  for (double s = -0.1; s <= 0.101; s += 0.05) {
    pixels.push_back(*camera.project({1.5 + s, 0.4 + 0.7 * s, 1.0 + 0.3 * s}));
  }
  const auto patch = UndistortedPatch::create(&camera, pixels[2], 40.0);
  ASSERT_TRUE(patch.has_value());
  const auto distance_from_line = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                     const Eigen::Vector2d& p) {
    const Eigen::Vector2d d = (b - a).normalized();
    return std::abs(d.x() * (p - a).y() - d.y() * (p - a).x());
  };
  EXPECT_GT(distance_from_line(pixels[0], pixels[4], pixels[2]), 0.05);
  EXPECT_LT(distance_from_line(patch->to_plane(pixels[0]), patch->to_plane(pixels[4]),
                               patch->to_plane(pixels[2])),
            1e-3);
}

TEST(UndistortedPatch, WithoutCameraItIsTheIdentity) {
  const auto patch = UndistortedPatch::create(nullptr, {100, 50}, 20.0);
  ASSERT_TRUE(patch.has_value());
  EXPECT_LT((patch->to_plane({111, 42}) - Eigen::Vector2d(111, 42)).norm(), 1e-12);
  EXPECT_LT((*patch->to_pixel({111, 42}) - Eigen::Vector2d(111, 42)).norm(), 1e-12);
}

}  // namespace
}  // namespace lvcalib
