// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/disturbances/lidar_angle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace lvcalib::simulation {

AngleDisturbance::AngleDisturbance(EffectPlan& plan, int lines)
    : azimuth_scale_(plan.si("angle_scale")),
      eccentricity_(plan.si("encoder_eccentricity")),
      wobble_tilt_rad_(plan.si("axis_wobble")),
      origin_m_(plan.si("beam_origin_offset")),
      lag_s_(plan.si("encoder_lag")) {
  elevation_scale_ = azimuth_scale_ * plan.random("angle_scale").uniform(-1.0, 1.0);
  plan.note("angle_scale", "elevation_ppm", 1e6 * elevation_scale_);
  eccentricity_phase_rad_ =
      plan.random("encoder_eccentricity").uniform(-std::numbers::pi, std::numbers::pi);
  plan.note("encoder_eccentricity", "phase_rad", eccentricity_phase_rad_);
  wobble_collimation_rad_ = wobble_tilt_rad_ * plan.random("axis_wobble").uniform(-0.5, 0.5);
  plan.note("axis_wobble", "collimation_mrad", 1e3 * wobble_collimation_rad_);
  const double line_rad = plan.si("channel_angle_offset");
  Random random = plan.random("channel_angle_offset");
  line_elevation_rad_ =
      plan.per_line("channel_angle_offset", "line_elevation_mrad", line_rad, 1e-3, lines, random);
  line_azimuth_rad_ = plan.per_line("channel_angle_offset", "line_azimuth_mrad", 0.5 * line_rad,
                                    1e-3, lines, random);
  active_ = azimuth_scale_ != 0.0 || eccentricity_ != 0.0 || wobble_tilt_rad_ != 0.0 ||
            lag_s_ != 0.0 || line_rad != 0.0;
}

Eigen::Vector3d AngleDisturbance::true_direction(const ScanPattern& pattern, const Shot& shot,
                                                 double delay_s) const {
  const double earlier = delay_s + lag_s_;
  const Eigen::Vector3d reported =
      earlier == 0.0 ? shot.direction : pattern.direction_at(shot, shot.time_s - earlier);
  if (!active_) return reported;
  double azimuth = std::atan2(reported.y(), reported.x());
  double elevation = std::asin(std::clamp(reported.z(), -1.0, 1.0));
  azimuth /= 1.0 + azimuth_scale_;
  elevation /= 1.0 + elevation_scale_;
  if (!line_elevation_rad_.empty()) {
    azimuth -= line_azimuth_rad_[shot.line];
    elevation -= line_elevation_rad_[shot.line];
  }
  const double from_phase = azimuth - eccentricity_phase_rad_;
  azimuth -=
      std::atan2(eccentricity_ * std::sin(from_phase), 1.0 + eccentricity_ * std::cos(from_phase));
  // In the frame that turns with the beam, x in its scan plane: swing it, then turn the plane.
  const double c = wobble_collimation_rad_;
  const double i = wobble_tilt_rad_;
  const Eigen::Vector3d swung(std::cos(c) * std::cos(elevation), -std::sin(c),
                              std::cos(c) * std::sin(elevation));
  const Eigen::Vector3d turned(swung.x(), std::cos(i) * swung.y() - std::sin(i) * swung.z(),
                               std::sin(i) * swung.y() + std::cos(i) * swung.z());
  const double cos_az = std::cos(azimuth);
  const double sin_az = std::sin(azimuth);
  return {cos_az * turned.x() - sin_az * turned.y(), sin_az * turned.x() + cos_az * turned.y(),
          turned.z()};
}

Eigen::Vector3d AngleDisturbance::start_m(const Eigen::Vector3d& direction) const {
  return -origin_m_ * Eigen::Vector3d::UnitZ().cross(direction).normalized();
}

}  // namespace lvcalib::simulation
