// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/rigid3.h"

#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "base/random.h"

namespace lvcalib {
namespace {

Vector6d random_xi(Random& random, double translation, double rotation) {
  Vector6d xi;
  for (int i = 0; i < 3; ++i) xi[i] = random.normal(0, translation);
  for (int i = 3; i < 6; ++i) xi[i] = random.normal(0, rotation);
  return xi;
}

double difference(const Rigid3& a, const Rigid3& b) {
  return (a.matrix() - b.matrix()).norm();
}

TEST(Rigid3, SkewIsTheCrossProduct) {
  const Eigen::Vector3d a(1, 2, 3);
  const Eigen::Vector3d b(-4, 5, 0.5);
  EXPECT_LT((skew(a) * b - a.cross(b)).norm(), 1e-15);
}

TEST(Rigid3, RotationLogInvertsExpUpToPi) {
  Random random(1);
  for (const double angle :
       {0.0, 1e-12, 1e-9, 1e-7, 1e-6, 1e-3, 0.5, 2.0, 3.0, std::numbers::pi - 1e-6}) {
    Eigen::Vector3d axis(random.normal(), random.normal(), random.normal());
    axis.normalize();
    const Eigen::Vector3d w = angle * axis;
    EXPECT_LT((so3_log(so3_exp(w)) - w).norm(), 1e-9 * (angle + 1e-6)) << angle;
    EXPECT_NEAR(so3_exp(w).norm(), 1.0, 1e-15);
    EXPECT_LT(
        (so3_exp(w).toRotationMatrix() - Eigen::AngleAxisd(angle, axis).toRotationMatrix()).norm(),
        1e-14);
  }
  // q and −q are one rotation; more than half a turn comes back the short way.
  const Eigen::Quaterniond q = so3_exp({0, 0, 4.0});
  EXPECT_NEAR(so3_log(q).z(), 4.0 - 2 * std::numbers::pi, 1e-12);
  EXPECT_NEAR((so3_log(Eigen::Quaterniond(-q.w(), -q.x(), -q.y(), -q.z())) - so3_log(q)).norm(), 0,
              1e-12);
}

TEST(Rigid3, RotationBetweenIsTheShortest) {
  const Eigen::Vector3d a(0.3, -2.0, 0.7);
  const Eigen::Vector3d b(-1.0, 0.2, 0.4);
  const Eigen::Quaterniond q = rotation_between(a, b);
  EXPECT_NEAR((q * a.normalized() - b.normalized()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(so3_log(q).norm(), std::acos(a.normalized().dot(b.normalized())), 1e-12);
  EXPECT_NEAR((rotation_between(a, -a) * a + a).norm(), 0.0, 1e-9);
}

TEST(Rigid3, MotionLogInvertsExp) {
  Random random(2);
  for (const double size : {1e-9, 1e-7, 1e-6, 1e-4, 0.1, 1.0}) {
    for (int i = 0; i < 50; ++i) {
      Vector6d xi = random_xi(random, size, size);
      if (xi.tail<3>().norm() > 3.0) xi.tail<3>() *= 3.0 / xi.tail<3>().norm();
      EXPECT_LT((se3_log(se3_exp(xi)) - xi).norm(), 1e-8 * size + 1e-15) << size;
    }
  }
}

TEST(Rigid3, ExpIsTheMatrixExponential) {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Vector6d xi = random_xi(random, 0.5, 0.5);
    Eigen::Matrix4d twist = Eigen::Matrix4d::Zero();
    twist.topLeftCorner<3, 3>() = skew(xi.tail<3>());
    twist.topRightCorner<3, 1>() = xi.head<3>();
    Eigen::Matrix4d sum = Eigen::Matrix4d::Identity();
    Eigen::Matrix4d term = Eigen::Matrix4d::Identity();
    for (int k = 1; k < 40; ++k) {
      term = term * twist / k;
      sum += term;
    }
    EXPECT_LT((se3_exp(xi).matrix() - sum).norm(), 1e-12);
  }
}

TEST(Rigid3, CompositionAndInverseAreThoseOfTheMatrices) {
  Random random(4);
  for (int i = 0; i < 20; ++i) {
    const Rigid3 a = se3_exp(random_xi(random, 1, 1));
    const Rigid3 b = se3_exp(random_xi(random, 1, 1));
    EXPECT_LT(((a * b).matrix() - a.matrix() * b.matrix()).norm(), 1e-13);
    EXPECT_LT(difference(a * a.inverse(), Rigid3{}), 1e-13);
    EXPECT_LT(difference(Rigid3::from_matrix(a.matrix()), a), 1e-13);
    const Eigen::Vector3d p(0.3, -2, 5);
    EXPECT_LT((a.inverse() * (a * p) - p).norm(), 1e-13);
  }
}

TEST(Rigid3, AdjointMovesAPerturbationToTheOtherSide) {
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    const Rigid3 t = se3_exp(random_xi(random, 1, 1));
    const Vector6d xi = random_xi(random, 0.3, 0.3);
    EXPECT_LT(difference(t * se3_exp(xi), se3_exp(t.adjoint() * xi) * t), 1e-12);
  }
}

TEST(Rigid3, DistancesAreAngleAndLength) {
  const Rigid3 a = se3_exp((Vector6d() << 1, 2, 3, 0.1, 0.2, 0.3).finished());
  Rigid3 b = a;
  b.rotation = a.rotation * so3_exp({0, 0.25, 0});
  b.translation += Eigen::Vector3d(0, 3, 4);
  EXPECT_NEAR(rotation_distance_rad(a, b), 0.25, 1e-12);
  EXPECT_NEAR(translation_distance_m(a, b), 5.0, 1e-12);
}

Matrix6d random_covariance(Random& random) {
  Matrix6d root;
  for (int i = 0; i < 36; ++i) root(i / 6, i % 6) = random.normal(0, 0.002);
  return root * root.transpose() + 1e-6 * Matrix6d::Identity();
}

// A draw from an uncertain transform: Exp(ξ)·T, ξ ~ N(0, Σ).
Rigid3 draw(const UncertainRigid3& t, const Matrix6d& root, Random& random) {
  const Vector6d white = random_xi(random, 1, 1);
  return se3_exp(root * white) * t.transform;
}

void expect_close_covariance(const Matrix6d& sampled, const Matrix6d& expected) {
  // Compared in units of the expected one; 20 000 draws give 1 % per entry.
  const Matrix6d whitening = expected.llt().matrixL().solve(Matrix6d::Identity().eval());
  const Matrix6d relative = whitening * sampled * whitening.transpose();
  EXPECT_LT((relative - Matrix6d::Identity()).cwiseAbs().maxCoeff(), 0.05) << relative;
}

TEST(UncertainRigid3, InverseAndCompositionAgreeWithMonteCarlo) {
  Random random(6);
  const UncertainRigid3 a{se3_exp(random_xi(random, 1, 1)), random_covariance(random)};
  const UncertainRigid3 b{se3_exp(random_xi(random, 1, 1)), random_covariance(random)};
  const Matrix6d root_a = a.covariance.llt().matrixL();
  const Matrix6d root_b = b.covariance.llt().matrixL();
  const UncertainRigid3 inverse = a.inverse();
  const UncertainRigid3 product = a * b;
  EXPECT_LT(difference(inverse.transform, a.transform.inverse()), 1e-13);
  EXPECT_LT(difference(product.transform, a.transform * b.transform), 1e-13);
  constexpr int kDraws = 20'000;
  Matrix6d of_inverse = Matrix6d::Zero();
  Matrix6d of_product = Matrix6d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Rigid3 drawn_a = draw(a, root_a, random);
    const Rigid3 drawn_b = draw(b, root_b, random);
    const Vector6d e = se3_log(drawn_a.inverse() * inverse.transform.inverse());
    const Vector6d f = se3_log(drawn_a * drawn_b * product.transform.inverse());
    of_inverse += e * e.transpose() / kDraws;
    of_product += f * f.transpose() / kDraws;
  }
  expect_close_covariance(of_inverse, inverse.covariance);
  expect_close_covariance(of_product, product.covariance);
}

// Two estimates of one transform, one of which knows what the other does not.
TEST(UncertainRigid3, TheMeanTakesEachDirectionFromWhoKnowsIt) {
  Random random(7);
  const Rigid3 truth = se3_exp(random_xi(random, 1, 1));
  Vector6d sideways = Vector6d::Zero();
  sideways(0) = 0.3;
  Vector6d turned = Vector6d::Zero();
  turned(5) = 0.02;
  UncertainRigid3 open{se3_exp(sideways) * truth, 1e-8 * Matrix6d::Identity()};
  open.covariance(0, 0) = 1.0;
  UncertainRigid3 loose{se3_exp(turned) * truth, 1e-6 * Matrix6d::Identity()};
  loose.covariance(5, 5) = 1.0;
  const UncertainRigid3 mean = information_mean({open, loose});
  EXPECT_LT(se3_log(mean.transform * truth.inverse()).norm(), 1e-4);
  EXPECT_NEAR(mean.covariance(0, 0), 1e-6, 1e-8);
  EXPECT_NEAR(mean.covariance(5, 5), 1e-8, 1e-10);
  EXPECT_NEAR(mean.covariance(1, 1), 1e-8 / 1.01, 1e-10);
  EXPECT_LT(difference(information_mean({open}).transform, open.transform), 1e-12);
}

}  // namespace
}  // namespace lvcalib
