// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "simulation/disturbances/effect_plan.h"

namespace lvcalib::simulation {

/// How the LiDAR moves while it scans: evenly, in a direction of its frame that is the same in
/// every scene, from the true pose at the scan's start. (The camera's own motion, the rolling
/// shutter, acts on its rays and stands with the camera.)
class MotionDisturbance {
 public:
  MotionDisturbance() = default;
  explicit MotionDisturbance(EffectPlan& plan);

  [[nodiscard]] bool active() const { return !velocity_m_s_.isZero(0.0); }

  /// Where the LiDAR's origin is, from where it was at the scan's start.
  [[nodiscard]] Eigen::Vector3d position_m(double time_s) const { return time_s * velocity_m_s_; }

 private:
  Eigen::Vector3d velocity_m_s_ = Eigen::Vector3d::Zero();
};

}  // namespace lvcalib::simulation
