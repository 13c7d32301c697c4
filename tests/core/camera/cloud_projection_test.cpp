// SPDX-License-Identifier: GPL-3.0-or-later
#include "camera/cloud_projection.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

TEST(CloudProjection, PointsOnAPixelsRayComeBackToThePixel) {
  const Camera camera = test::test_camera();
  const Rigid3 camera_from_lidar = test::test_extrinsic();
  Random random(1);
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector2d> truth;
  for (int i = 0; i < 40'000; ++i) {
    const Eigen::Vector2d pixel(random.uniform(1, 1438), random.uniform(1, 898));
    const auto ray = camera.unproject(pixel);
    ASSERT_TRUE(ray);
    const double range = random.uniform(1.0, 20.0);
    points.push_back((camera_from_lidar.inverse() * (range * *ray)).cast<float>());
    truth.push_back(pixel);
  }
  // Behind the camera, and far beside its field of view.
  points.push_back((camera_from_lidar.inverse() * Eigen::Vector3d(0, 0, -3)).cast<float>());
  points.push_back((camera_from_lidar.inverse() * Eigen::Vector3d(9, 0, 1)).cast<float>());
  const auto pixels = project_points(points, camera, camera_from_lidar, {});
  ASSERT_EQ(pixels.size(), points.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    // Single-precision coordinates: a micrometre at 20 m is 1e-4 px.
    ASSERT_LT((pixels[i].cast<double>() - truth[i]).norm(), 2e-3) << i;
  }
  EXPECT_TRUE(std::isnan(pixels[40'000].x()));
  EXPECT_TRUE(std::isnan(pixels[40'001].x()));
}

TEST(CloudProjection, StopsWhenAsked) {
  std::stop_source source;
  source.request_stop();
  const std::vector<Eigen::Vector3f> points(100, Eigen::Vector3f(3, 0, 0));
  RunContext context;
  context.stop = source.get_token();
  const auto pixels = project_points(points, test::test_camera(), test::test_extrinsic(), context);
  ASSERT_EQ(pixels.size(), 100U);
  EXPECT_TRUE(std::isnan(pixels[0].x()));
}

TEST(CloudProjection, NearestPixelsInOrderAndWithinTheRadius) {
  const float nan = std::nanf("");
  const std::vector<Eigen::Vector2f> pixels{{10, 10}, {nan, nan}, {12, 10}, {10.5F, 10}, {90, 90}};
  EXPECT_EQ(nearest_pixels(pixels, {10.1, 10}, 5, 5.0), (std::vector<std::uint32_t>{0, 3, 2}));
  EXPECT_EQ(nearest_pixels(pixels, {10.1, 10}, 1, 5.0), (std::vector<std::uint32_t>{0}));
  EXPECT_TRUE(nearest_pixels(pixels, {50, 50}, 5, 5.0).empty());
  EXPECT_TRUE(nearest_pixels({}, {50, 50}, 5, 5.0).empty());
}

}  // namespace
}  // namespace lvcalib
