// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "simulation/disturbances/effect_plan.h"
#include "simulation/scan_pattern.h"

namespace lvcalib::simulation {

/// Errors of the scanner's directions. Azimuth is atan2(y, x), elevation the angle above the x–y
/// plane; errors are reported − true.
///
/// Eccentricity: a disc read at a distance e from its centre shows
/// atan2(e sin(az − φ), 1 + e cos(az − φ)) too much. Wobble: the beam, swung off the scan plane
/// by the collimation error c and with the plane turned by i about the line of sight, is turned in
/// full; to first order the azimuth is c sec(el) + i tan(el) too large.
class AngleDisturbance {
 public:
  AngleDisturbance() = default;
  AngleDisturbance(EffectPlan& plan, int lines);

  [[nodiscard]] bool active() const { return active_; }

  /// Where the beam of a shot truly goes, `delay_s` before the shot's time; unit length.
  [[nodiscard]] Eigen::Vector3d true_direction(const ScanPattern& pattern, const Shot& shot,
                                               double delay_s = 0.0) const;

  /// Where a beam of this direction starts, from the LiDAR's origin.
  [[nodiscard]] Eigen::Vector3d start_m(const Eigen::Vector3d& direction) const;
  [[nodiscard]] bool moves_start() const { return origin_m_ != 0.0; }

 private:
  bool active_ = false;
  double azimuth_scale_ = 0.0;
  double elevation_scale_ = 0.0;
  double eccentricity_ = 0.0;
  double eccentricity_phase_rad_ = 0.0;
  double wobble_tilt_rad_ = 0.0;
  double wobble_collimation_rad_ = 0.0;
  std::vector<double> line_elevation_rad_;
  std::vector<double> line_azimuth_rad_;
  double origin_m_ = 0.0;
  double lag_s_ = 0.0;
};

}  // namespace lvcalib::simulation
