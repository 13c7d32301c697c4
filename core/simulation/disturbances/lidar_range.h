// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "simulation/disturbances/effect_plan.h"

namespace lvcalib::simulation {

/// What a shot's range error may depend on.
struct RangeConditions {
  double range_m = 0.0;  ///< Without error.
  double power = 0.0;    ///< Received, ρ cos θ / r² over the footprint.
  double cos_incidence = 1.0;
  double azimuth_rad = 0.0;  ///< Reported.
  double clock_s = 0.0;      ///< Since the device was switched on.
  double time_s = 0.0;       ///< Since the scan started.
  std::uint16_t line = 0;
};

/// Errors of the range finder.
///
/// Walk: a Gaussian pulse exp(−t²/2s²) of height P starts the clock when it crosses a threshold V,
/// t = −s √(2 ln P/V): weak echoes start it late. s is such that black print comes back later than
/// white by the planted value, both seen squarely at 3 m; white there has no error. The threshold
/// is an eighth of black's power there.
/// Cyclic: crosstalk at the modulation frequency, with 15 % of its second harmonic.
/// Warm-up: electronics and housing settle with time constants of 60 s and 240 s, 70 : 30.
/// Drift: the laser is switched on for every scan and settles with 0.2 s and 0.8 s, 70 : 30.
class RangeDisturbance {
 public:
  /// Time between the starts of two scenes.
  static constexpr double kSceneIntervalS = 20.0;

  RangeDisturbance() = default;
  RangeDisturbance(EffectPlan& plan, int lines);

  [[nodiscard]] bool active() const { return active_; }

  /// Reported − true range.
  [[nodiscard]] double error_m(const RangeConditions& shot) const;

 private:
  [[nodiscard]] double walk_m(double power) const;
  [[nodiscard]] double cyclic_m(double range_m) const;
  [[nodiscard]] double warmup_m(double clock_s) const;
  [[nodiscard]] double drift_m(double time_s) const;

  bool active_ = false;
  double offset_m_ = 0.0;
  double scale_ = 0.0;
  double walk_width_m_ = 0.0;  // Pulse width s times c/2.
  double incidence_m_ = 0.0;
  double cyclic_m_ = 0.0;
  double cyclic_unit_m_ = 1.0;
  double cyclic_phase_rad_ = 0.0;
  double second_phase_rad_ = 0.0;
  double near_m_ = 0.0;
  double warmup_m_ = 0.0;
  double drift_m_ = 0.0;
  std::vector<double> line_m_;
  double ripple_m_ = 0.0;
  double ripple_periods_ = 0.0;
  double ripple_phase_rad_ = 0.0;
};

}  // namespace lvcalib::simulation
