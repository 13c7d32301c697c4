// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/disturbances/lidar_range.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/printed_board.h"

namespace lvcalib::simulation {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kReferenceRange = 3.0;
constexpr double kThreshold = PrintedBoard::kBlack / (kReferenceRange * kReferenceRange) / 8.0;
// Just above the threshold the crossing time has no limit; such echoes would be missed.
constexpr double kWeakest = 1.05;
constexpr double kNearRange = 1.5;
constexpr double kLeastCosine = 0.1;

// √(2 ln P/V): how many pulse widths before its peak a pulse crosses the threshold.
double lead(double power) {
  return std::sqrt(2.0 * std::log(std::max(kWeakest, power / kThreshold)));
}

double power_at_reference(double reflectivity) {
  return reflectivity / (kReferenceRange * kReferenceRange);
}

}  // namespace

RangeDisturbance::RangeDisturbance(EffectPlan& plan, int lines)
    : offset_m_(plan.si("range_offset")),
      scale_(plan.si("range_scale")),
      incidence_m_(plan.si("range_incidence")),
      cyclic_m_(plan.si("range_cyclic")),
      near_m_(plan.si("range_near")),
      warmup_m_(plan.si("range_warmup")),
      drift_m_(plan.si("range_drift")),
      ripple_m_(plan.si("x_azimuth_ripple")) {
  const double white = lead(power_at_reference(PrintedBoard::kWhite));
  const double black = lead(power_at_reference(PrintedBoard::kBlack));
  walk_width_m_ = plan.si("range_walk") / (white - black);
  plan.note("range_walk", "pulse_width_mm", 1e3 * walk_width_m_);
  plan.note("range_walk", "threshold_power", kThreshold);

  Random cyclic = plan.random("range_cyclic");
  cyclic_unit_m_ = 0.1 * std::pow(4.0, cyclic.uniform());  // 0.1 to 0.4 m, even in its logarithm.
  cyclic_phase_rad_ = cyclic.uniform(0.0, kTurn);
  second_phase_rad_ = cyclic.uniform(0.0, kTurn);
  plan.note("range_cyclic", "unit_m", cyclic_unit_m_);
  plan.note("range_cyclic", "phase_rad", cyclic_phase_rad_);
  plan.note("range_cyclic", "second_harmonic_share", 0.15);

  plan.note("range_near", "decay_m", kNearRange);
  plan.note("range_warmup", "time_constants_s", {60.0, 240.0});
  plan.note("range_warmup", "scene_interval_s", kSceneIntervalS);
  plan.note("range_drift", "time_constants_s", {0.2, 0.8});
  Random random = plan.random("channel_range_offset");
  line_m_ = plan.per_line("channel_range_offset", "line_mm", plan.si("channel_range_offset"), 1e-3,
                          lines, random);

  Random ripple = plan.random("x_azimuth_ripple");
  ripple_periods_ = 15.0 + ripple.below(11);
  ripple_phase_rad_ = ripple.uniform(0.0, kTurn);
  plan.note("x_azimuth_ripple", "periods_per_turn", ripple_periods_);
  plan.note("x_azimuth_ripple", "phase_rad", ripple_phase_rad_);
  active_ = offset_m_ != 0.0 || scale_ != 0.0 || walk_width_m_ != 0.0 || incidence_m_ != 0.0 ||
            cyclic_m_ != 0.0 || near_m_ != 0.0 || warmup_m_ != 0.0 || drift_m_ != 0.0 ||
            ripple_m_ != 0.0 || plan.si("channel_range_offset") != 0.0;
}

double RangeDisturbance::walk_m(double power) const {
  return walk_width_m_ * (lead(power_at_reference(PrintedBoard::kWhite)) - lead(power));
}

double RangeDisturbance::cyclic_m(double range_m) const {
  const double phase = kTurn * range_m / cyclic_unit_m_ + cyclic_phase_rad_;
  return cyclic_m_ * (std::sin(phase) + 0.15 * std::sin(2.0 * phase + second_phase_rad_));
}

double RangeDisturbance::warmup_m(double clock_s) const {
  return warmup_m_ * (0.7 * std::exp(-clock_s / 60.0) + 0.3 * std::exp(-clock_s / 240.0));
}

double RangeDisturbance::drift_m(double time_s) const {
  return drift_m_ * (1.0 - 0.7 * std::exp(-time_s / 0.2) - 0.3 * std::exp(-time_s / 0.8));
}

double RangeDisturbance::error_m(const RangeConditions& shot) const {
  double error = offset_m_ + scale_ * shot.range_m;
  if (walk_width_m_ != 0.0) error += walk_m(shot.power);
  if (incidence_m_ != 0.0) {
    error += incidence_m_ * (1.0 / std::max(kLeastCosine, shot.cos_incidence) - 1.0);
  }
  if (cyclic_m_ != 0.0) error += cyclic_m(shot.range_m);
  if (near_m_ != 0.0) error += near_m_ * std::exp(-shot.range_m / kNearRange);
  if (warmup_m_ != 0.0) error += warmup_m(shot.clock_s);
  if (drift_m_ != 0.0) error += drift_m(shot.time_s);
  if (!line_m_.empty()) error += line_m_[shot.line];
  if (ripple_m_ != 0.0) {
    error += ripple_m_ * std::sin(ripple_periods_ * shot.azimuth_rad + ripple_phase_rad_);
  }
  return error;
}

}  // namespace lvcalib::simulation
