// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "base/rigid3.h"

namespace lvcalib {

/// Roll, pitch and yaw with R = Rz(yaw)·Ry(pitch)·Rx(roll) (ROS, URDF): turns about the fixed axes
/// x, then y, then z.
struct RollPitchYaw {
  Eigen::Vector3d angles_rad = Eigen::Vector3d::Zero();  ///< Roll, pitch, yaw.
  Eigen::Vector3d sigmas_rad = Eigen::Vector3d::Zero();  ///< Their standard deviations.
  /// Pitch so near ±90° that roll and yaw cannot be told apart; roll is then set to 0 and the
  /// standard deviations of roll and yaw are infinite.
  bool gimbal_locked = false;
};

/// Angles of a rotation, with the standard deviations that the covariance of the transform's left
/// perturbation gives to first order: with R' = Exp(ω)R, roll' = roll + (cy·ωx + sy·ωy)/cp,
/// pitch' = pitch − sy·ωx + cy·ωy, yaw' = yaw + ωz + tan(p)(cy·ωx + sy·ωy).
RollPitchYaw roll_pitch_yaw(const UncertainRigid3& transform);

}  // namespace lvcalib
