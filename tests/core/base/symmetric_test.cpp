// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/symmetric.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lvcalib {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

// Positive definite, with axes along none of the coordinates'.
Matrix6d covariance() {
  Matrix6d root;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) root(i, j) = std::sin(1.0 + 3.0 * i + 1.7 * j * j);
  }
  return root * root.transpose() + 0.1 * Matrix6d::Identity();
}

TEST(SymmetricAxes, ComposeTheMatrixInAscendingOrder) {
  const Matrix6d m = covariance();
  const auto axes = axes_of(m);
  EXPECT_NEAR((axes.vectors * axes.values.asDiagonal() * axes.vectors.transpose() - m).norm(), 0.0,
              1e-12 * m.norm());
  EXPECT_NEAR((axes.vectors.transpose() * axes.vectors - Matrix6d::Identity()).norm(), 0.0, 1e-12);
  for (int k = 1; k < 6; ++k) EXPECT_LE(axes.values(k - 1), axes.values(k));
  const auto dynamic = axes_of(Eigen::MatrixXd(m));
  EXPECT_NEAR((dynamic.values - axes.values).norm(), 0.0, 1e-12 * m.norm());
}

TEST(SymmetricAxes, OfTheLowerTriangle) {
  const Eigen::Matrix2d m = (Eigen::Matrix2d() << 2.0, 77.0, 1.0, 2.0).finished();
  EXPECT_NEAR((axes_of(m).values - Eigen::Vector2d(1.0, 3.0)).norm(), 0.0, 1e-14);
}

TEST(WithoutNegativeAxes, KeepsWhatIsACovariance) {
  const Eigen::Matrix2d m = (Eigen::Matrix2d() << 2.0, 0.5, 0.5, 1.0).finished();
  EXPECT_NEAR((without_negative_axes(m) - m).norm(), 0.0, 1e-12);
}

// Along (1, 1) three, along (1, −1) minus one: the first is left.
TEST(WithoutNegativeAxes, TakesOutTheAxisBelowZero) {
  const Eigen::Matrix2d m = (Eigen::Matrix2d() << 1.0, 2.0, 2.0, 1.0).finished();
  EXPECT_NEAR((without_negative_axes(m) - Eigen::Matrix2d::Constant(1.5)).norm(), 0.0, 1e-12);
}

TEST(LargestSigma, IsAlongTheLongestAxis) {
  const Eigen::Vector3d along = Eigen::Vector3d(1.0, 2.0, -2.0) / 3.0;
  const Eigen::Matrix3d m = Eigen::Matrix3d::Identity() + 8.0 * along * along.transpose();
  EXPECT_NEAR(largest_sigma(m), 3.0, 1e-12);
  EXPECT_EQ(largest_sigma(-m), 0.0);
}

TEST(SquaredMahalanobis, IsTheDistanceInStandardDeviationsAlongAnAxis) {
  const Matrix6d m = covariance();
  const auto axes = axes_of(m);
  const Vector6d x = 2.5 * std::sqrt(axes.values(3)) * axes.vectors.col(3);
  EXPECT_NEAR(squared_mahalanobis(x, m), 6.25, 1e-9);
  EXPECT_NEAR(squared_mahalanobis(Eigen::VectorXd(x), Eigen::MatrixXd(m)), 6.25, 1e-9);
}

TEST(SymmetricInverse, TimesTheMatrixIsTheIdentity) {
  const Matrix6d m = covariance();
  EXPECT_NEAR((symmetric_inverse(m) * m - Matrix6d::Identity()).norm(), 0.0, 1e-10);
  EXPECT_NEAR((symmetric_inverse(Eigen::MatrixXd(m)) - symmetric_inverse(m)).norm(), 0.0, 1e-10);
}

}  // namespace
}  // namespace lvcalib
