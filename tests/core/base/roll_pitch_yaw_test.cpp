// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/roll_pitch_yaw.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.h"

namespace lvcalib {
namespace {

Eigen::Matrix3d composed(const Eigen::Vector3d& angles) {
  return (Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

TEST(RollPitchYaw, GivesBackTheAnglesOfARotation) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d angles(random.uniform(-3.1, 3.1), random.uniform(-1.5, 1.5),
                                 random.uniform(-3.1, 3.1));
    UncertainRigid3 transform;
    transform.transform = Rigid3::from_matrix(composed(angles), Eigen::Vector3d::Zero());
    EXPECT_LT((roll_pitch_yaw(transform).angles_rad - angles).norm(), 1e-9);
  }
}

// The standard deviations are those of angles drawn from the stated perturbation.
TEST(RollPitchYaw, SigmasAreThoseOfDrawnRotations) {
  Random random(5);
  UncertainRigid3 transform;
  transform.transform = Rigid3::from_matrix(composed({0.4, -0.9, 2.0}), {1, 2, 3});
  const Eigen::Vector3d sigma(1e-3, 2e-3, 0.5e-3);
  transform.covariance.bottomRightCorner<3, 3>() = sigma.cwiseAbs2().asDiagonal();
  const RollPitchYaw stated = roll_pitch_yaw(transform);
  Eigen::Vector3d sum_sq = Eigen::Vector3d::Zero();
  constexpr int kDraws = 20'000;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    const double y = random.normal();
    const double z = random.normal();
    UncertainRigid3 drawn;
    drawn.transform.rotation =
        so3_exp(sigma.cwiseProduct(Eigen::Vector3d(x, y, z))) * transform.transform.rotation;
    sum_sq += (roll_pitch_yaw(drawn).angles_rad - stated.angles_rad).cwiseAbs2();
  }
  const Eigen::Vector3d measured = (sum_sq / kDraws).cwiseSqrt();
  // 20 000 draws measure a standard deviation to 0.5 %.
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(stated.sigmas_rad(k) / measured(k), 1.0, 0.025) << k;
}

TEST(RollPitchYaw, SaysWhenRollAndYawCannotBeToldApart) {
  UncertainRigid3 transform;
  transform.covariance.setIdentity();
  transform.transform =
      Rigid3::from_matrix(composed({0.3, 0.5 * std::numbers::pi, 1.0}), Eigen::Vector3d::Zero());
  const RollPitchYaw result = roll_pitch_yaw(transform);
  EXPECT_TRUE(result.gimbal_locked);
  EXPECT_TRUE(std::isinf(result.sigmas_rad.x()));
  EXPECT_NEAR(result.sigmas_rad.y(), 1.0, 1e-9);
  EXPECT_TRUE(
      composed(result.angles_rad).isApprox(transform.transform.rotation.toRotationMatrix(), 1e-6));
}

}  // namespace
}  // namespace lvcalib
