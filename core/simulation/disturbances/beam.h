// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "simulation/disturbances/effect_plan.h"
#include "simulation/simulation_options.h"

namespace lvcalib::simulation {

/// What is unusual about the footprint and how the receiver sums it up.
///
/// Blooming: the intensity is a power mean (Σ wᵢ ρᵢ^q)^(1/q) over the sub-rays instead of their
/// mean. Plain surfaces keep their level, edges move towards the dark side; q is such that between
/// black and white print a straight edge moves by κ σ ln(white/black).
/// Detector lag: the receiver's level settles exponentially, so the intensity is that of directions
/// passed up to several time constants before; two nodes of Gauss–Laguerre quadrature stand for
/// the exponential (exact in mean, variance and third moment).
/// Footprint offset: the intensity comes from beside the axis along which the range is measured.
class BeamDisturbance {
 public:
  struct Lag {
    double weight, delay_s;
  };

  BeamDisturbance() = default;
  BeamDisturbance(EffectPlan& plan, const LidarOptions& lidar);

  /// One sigma of the footprint's half angle, instead of the options'.
  [[nodiscard]] double horizontal_mrad(const LidarOptions& lidar) const {
    return horizontal_mrad_.value_or(lidar.beam_horizontal_mrad);
  }
  [[nodiscard]] double vertical_mrad(const LidarOptions& lidar) const {
    return vertical_mrad_.value_or(lidar.beam_vertical_mrad);
  }

  /// Outward shift of black edges in the LiDAR's light.
  [[nodiscard]] double edge_shift_m() const { return edge_shift_m_; }

  /// Exponent q of the power mean; 1 without blooming.
  [[nodiscard]] double mean_exponent() const { return mean_exponent_; }

  /// Factor on the distance between power-weighted and axis range on one surface.
  [[nodiscard]] double range_pull() const { return range_pull_; }

  /// Whether the intensity comes from elsewhere than the range.
  [[nodiscard]] bool splits_intensity() const {
    return lag_s_ != 0.0 || offset_horizontal_rad_ != 0.0 || offset_vertical_rad_ != 0.0;
  }
  /// From where: delays with their weights (the second has none without a lag) …
  [[nodiscard]] std::array<Lag, 2> lags() const;
  /// … and the angle beside the axis, towards growing azimuth and elevation.
  [[nodiscard]] double offset_horizontal_rad() const { return offset_horizontal_rad_; }
  [[nodiscard]] double offset_vertical_rad() const { return offset_vertical_rad_; }

 private:
  void set_divergence(EffectPlan& plan, const LidarOptions& lidar);

  std::optional<double> horizontal_mrad_;
  std::optional<double> vertical_mrad_;
  double edge_shift_m_ = 0.0;
  double mean_exponent_ = 1.0;
  double range_pull_ = 1.0;
  double offset_horizontal_rad_ = 0.0;
  double offset_vertical_rad_ = 0.0;
  double lag_s_ = 0.0;
};

}  // namespace lvcalib::simulation
