// SPDX-License-Identifier: BSD-3-Clause
#include "base/roll_pitch_yaw.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lvcalib {

RollPitchYaw roll_pitch_yaw(const UncertainRigid3& transform) {
  RollPitchYaw out;
  const Eigen::Matrix3d R = transform.transform.rotation.toRotationMatrix();
  const double pitch = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
  const double cos_pitch = std::hypot(R(0, 0), R(1, 0));
  if (cos_pitch < 1e-6) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    out.gimbal_locked = true;
    out.angles_rad = {0.0, pitch, std::atan2(-R(0, 1), R(1, 1))};
    const double yaw = out.angles_rad.z();
    const Eigen::Vector3d by_pitch(-std::sin(yaw), std::cos(yaw), 0.0);
    out.sigmas_rad = {
        kInfinite,
        std::sqrt(by_pitch.dot(transform.covariance.bottomRightCorner<3, 3>() * by_pitch)),
        kInfinite};
    return out;
  }
  const double yaw = std::atan2(R(1, 0), R(0, 0));
  out.angles_rad = {std::atan2(R(2, 1), R(2, 2)), pitch, yaw};
  const double cy = std::cos(yaw);
  const double sy = std::sin(yaw);
  const double tan_pitch = std::tan(pitch);
  Eigen::Matrix3d by_rotation;
  by_rotation << cy / cos_pitch, sy / cos_pitch, 0.0,  //
      -sy, cy, 0.0,                                    //
      tan_pitch * cy, tan_pitch * sy, 1.0;
  out.sigmas_rad =
      (by_rotation * transform.covariance.bottomRightCorner<3, 3>() * by_rotation.transpose())
          .diagonal()
          .cwiseMax(0.0)
          .cwiseSqrt();
  return out;
}

}  // namespace lvcalib
