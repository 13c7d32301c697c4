// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/disturbances/motion.h"

namespace lvcalib::simulation {

MotionDisturbance::MotionDisturbance(EffectPlan& plan) {
  Random random = plan.random("scan_motion");
  Eigen::Vector3d direction;
  do {
    for (double& part : direction) part = random.uniform(-1.0, 1.0);
  } while (direction.norm() > 1.0 || direction.norm() < 0.1);
  velocity_m_s_ = plan.si("scan_motion") * direction.normalized();
  plan.note("scan_motion", "velocity_mm_s",
            {1e3 * velocity_m_s_.x(), 1e3 * velocity_m_s_.y(), 1e3 * velocity_m_s_.z()});
}

}  // namespace lvcalib::simulation
