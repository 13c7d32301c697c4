// SPDX-License-Identifier: BSD-3-Clause
#include "base/rigid3.h"

#include <cmath>

#include <Eigen/Cholesky>

#include "base/symmetric.h"

namespace lvcalib {
namespace {

// Left Jacobian of SO(3): ∫₀¹ Exp(s w) ds.
Eigen::Matrix3d so3_left_jacobian(const Eigen::Vector3d& w) {
  const double angle_sq = w.squaredNorm();
  const Eigen::Matrix3d W = skew(w);
  if (angle_sq < 1e-12) return Eigen::Matrix3d::Identity() + 0.5 * W + W * W / 6.0;
  const double angle = std::sqrt(angle_sq);
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / angle_sq * W +
         (angle - std::sin(angle)) / (angle_sq * angle) * W * W;
}

}  // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Eigen::Quaterniond so3_exp(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  // sin(x/2)/x → 1/2 − x²/48 near zero.
  const double k = angle < 1e-6 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  return Eigen::Quaterniond(std::cos(0.5 * angle), k * w.x(), k * w.y(), k * w.z()).normalized();
}

Eigen::Vector3d so3_log(const Eigen::Quaterniond& q) {
  Eigen::Quaterniond p = q.normalized();
  if (p.w() < 0) p.coeffs() *= -1.0;
  const double s = p.vec().norm();
  if (s < 1e-9) return 2.0 * p.vec();
  return 2.0 * std::atan2(s, p.w()) / s * p.vec();
}

Eigen::Quaterniond rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

Rigid3 Rigid3::from_matrix(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
  return {Eigen::Quaterniond(rotation).normalized(), translation};
}

Rigid3 Rigid3::from_matrix(const Eigen::Matrix4d& matrix) {
  return from_matrix(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>()),
                     Eigen::Vector3d(matrix.topRightCorner<3, 1>()));
}

Eigen::Matrix4d Rigid3::matrix() const {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = rotation.toRotationMatrix();
  m.topRightCorner<3, 1>() = translation;
  return m;
}

Rigid3 Rigid3::inverse() const {
  const Eigen::Quaterniond inverse_rotation = rotation.conjugate();
  return {inverse_rotation, -(inverse_rotation * translation)};
}

Matrix6d Rigid3::adjoint() const {
  const Eigen::Matrix3d R = rotation.toRotationMatrix();
  Matrix6d ad = Matrix6d::Zero();
  ad.topLeftCorner<3, 3>() = R;
  ad.topRightCorner<3, 3>() = skew(translation) * R;
  ad.bottomRightCorner<3, 3>() = R;
  return ad;
}

Rigid3 se3_exp(const Vector6d& xi) {
  const Eigen::Vector3d w = xi.tail<3>();
  return {so3_exp(w), so3_left_jacobian(w) * xi.head<3>()};
}

Vector6d se3_log(const Rigid3& transform) {
  Vector6d xi;
  xi.tail<3>() = so3_log(transform.rotation);
  xi.head<3>() = so3_left_jacobian(xi.tail<3>()).partialPivLu().solve(transform.translation);
  return xi;
}

UncertainRigid3 UncertainRigid3::inverse() const {
  // (Exp(ξ) T)⁻¹ = T⁻¹ Exp(−ξ) = Exp(−Ad(T⁻¹) ξ) T⁻¹.
  const Rigid3 inv = transform.inverse();
  const Matrix6d ad = inv.adjoint();
  return {inv, ad * covariance * ad.transpose()};
}

UncertainRigid3 UncertainRigid3::operator*(const UncertainRigid3& other) const {
  const Matrix6d ad = transform.adjoint();
  return {transform * other.transform, covariance + ad * other.covariance * ad.transpose()};
}

UncertainRigid3 information_mean(const std::vector<UncertainRigid3>& estimates) {
  UncertainRigid3 out = estimates.front();
  // Estimates are some milliradians apart: two steps would do.
  constexpr int kSteps = 5;
  for (int i = 0; i < kSteps; ++i) {
    Matrix6d information = Matrix6d::Zero();
    Vector6d rhs = Vector6d::Zero();
    for (const UncertainRigid3& t : estimates) {
      const Matrix6d weight = symmetric_inverse(t.covariance);
      information += weight;
      rhs += weight * se3_log(t.transform * out.transform.inverse());
    }
    const Eigen::LDLT<Matrix6d> factor(information);
    const Vector6d step = factor.solve(rhs);
    if (!step.allFinite()) break;
    out.transform = se3_exp(step) * out.transform;
    out.covariance = factor.solve(Matrix6d::Identity());
  }
  return out;
}

double rotation_distance_rad(const Rigid3& a, const Rigid3& b) {
  return so3_log(a.rotation.conjugate() * b.rotation).norm();
}

double translation_distance_m(const Rigid3& a, const Rigid3& b) {
  return (a.translation - b.translation).norm();
}

}  // namespace lvcalib
