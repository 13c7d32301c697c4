// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace lvcalib {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Skew-symmetric matrix [v]ₓ with [v]ₓ w = v × w.
Eigen::Matrix3d skew(const Eigen::Vector3d& v);

/// Rotation by |w| radians about w.
Eigen::Quaterniond so3_exp(const Eigen::Vector3d& w);

/// Inverse of so3_exp; the result's norm is at most π.
Eigen::Vector3d so3_log(const Eigen::Quaterniond& q);

/// Shortest rotation that takes the direction of `from` to that of `to`.
Eigen::Quaterniond rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// A rigid transform a_from_b: takes a point in frame b to frame a. Variables are named
/// `camera_from_lidar`, so that a_from_b * b_from_c reads right and a wrong order reads wrong.
struct Rigid3 {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  static Rigid3 from_matrix(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation);
  static Rigid3 from_matrix(const Eigen::Matrix4d& matrix);

  [[nodiscard]] Eigen::Matrix4d matrix() const;
  [[nodiscard]] Rigid3 inverse() const;
  /// 6×6 adjoint for the order (translation, rotation): Ad(T) ξ is ξ seen from the left frame.
  [[nodiscard]] Matrix6d adjoint() const;

  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return rotation * point + translation;
  }
  Rigid3 operator*(const Rigid3& other) const {
    return {(rotation * other.rotation).normalized(), *this * other.translation};
  }
};

/// SE(3) exponential of ξ = (translation, rotation); small motions: t ≈ ξ[0..2], ω = ξ[3..5].
Rigid3 se3_exp(const Vector6d& xi);

/// Inverse of se3_exp.
Vector6d se3_log(const Rigid3& transform);

/// A transform with the covariance of its left perturbation: truth = Exp(ξ) · transform with
/// ξ = (tx ty tz [m], rx ry rz [rad]) ~ N(0, covariance), expressed in the left frame.
struct UncertainRigid3 {
  Rigid3 transform;
  Matrix6d covariance = Matrix6d::Zero();

  [[nodiscard]] UncertainRigid3 inverse() const;
  /// Composition of independent transforms.
  UncertainRigid3 operator*(const UncertainRigid3& other) const;
};

/// Information-weighted mean of independent estimates of one transform, with its covariance:
/// Gauss–Newton from the first of them on Σ ξᵢᵀ Σᵢ⁻¹ ξᵢ with ξᵢ = Log(Tᵢ T⁻¹). At least one is
/// given, and every covariance is positive definite.
UncertainRigid3 information_mean(const std::vector<UncertainRigid3>& estimates);

/// Angle of the rotation between two transforms, in radians.
double rotation_distance_rad(const Rigid3& a, const Rigid3& b);

/// Distance between the origins of two transforms, in metres.
double translation_distance_m(const Rigid3& a, const Rigid3& b);

}  // namespace lvcalib
