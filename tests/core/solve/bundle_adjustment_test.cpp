// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/bundle_adjustment.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

constexpr double kNoise_px = 0.1;

// Resection: points of one body that is no plane tell camera and pose from one image.
TEST(BundleAdjustment, OneBodyTellsTheCamera) {
  Random random(3);
  const Rigid3 pose = se3_exp((Vector6d() << 0.1, -0.05, 0.2, 0.1, -0.2, 0.3).finished());
  SeenPoints body;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = 0; z < 3; ++z) {
        const Eigen::Vector3d in_camera(0.22 * x * (2.0 + z), 0.28 * y * (2.0 + z), 2.0 + z);
        body.point_m.push_back(pose.inverse() * in_camera);
        Eigen::Vector2d e;
        for (double& part : e) part = random.normal();
        body.pixel.push_back(*test::test_camera().project(in_camera) + kNoise_px * e);
      }
    }
  }
  Camera given = test::test_camera();
  given.fx *= 1.3;
  given.fy *= 1.3;
  given.cx += 40.0;
  const Rigid3 start = se3_exp(Vector6d::Constant(0.05)) * pose;
  const auto fit = fit_bundle({body}, {start}, given, wide_intrinsics_sigma(given));
  ASSERT_TRUE(fit);
  const IntrinsicsVector off = intrinsics_of(fit->camera) - intrinsics_of(test::test_camera());
  for (Eigen::Index k = 0; k < 9; ++k)
    EXPECT_LT(std::abs(off(k)), 4.0 * std::sqrt(fit->covariance(k, k))) << k;
  EXPECT_LT(std::abs(off(0)), 3.0);
  EXPECT_NEAR(fit->sigma_px, kNoise_px, 0.3 * kNoise_px);
  EXPECT_EQ(fit->freedom, 2.0 * 45 - 6.0 - 9.0);
  EXPECT_LT(translation_distance_m(fit->poses.front(), pose), 0.02);
}

TEST(BundleAdjustment, NeedsPointsAndImagesOfThem) {
  SeenPoints few;
  for (int k = 0; k < 7; ++k) {
    few.point_m.emplace_back(0.1 * k, 0.01 * k * k, 2.0);
    few.pixel.emplace_back(405.0 + 30.0 * k, 246.0);
  }
  const IntrinsicsVector held = IntrinsicsVector::Zero();
  EXPECT_FALSE(fit_bundle({few}, {Rigid3()}, test::test_camera(), held));
  few.point_m.emplace_back(0.0, 0.0, -1.0);  // Behind the camera.
  few.pixel.emplace_back(400.0, 250.0);
  EXPECT_FALSE(fit_bundle({few}, {Rigid3()}, test::test_camera(), held));
}

}  // namespace
}  // namespace lvcalib
