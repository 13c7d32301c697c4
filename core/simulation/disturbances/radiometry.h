// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "simulation/disturbances/effect_plan.h"
#include "simulation/simulation_options.h"

namespace lvcalib::simulation {

/// How light becomes an intensity.
///
/// Gloss: the Beckmann lobe exp(−tan²θ/m²)/cos⁴θ of a surface with roughness m = 0.15 adds to the
/// board's reflectivity, so to power, range and intensity alike.
/// Saturation: above 60 % of the power of white at 3 m the receiver's output is clipped; the
/// overload bends the timing with the logarithm of the excess.
/// Smudge: a place on the LiDAR's window keeps back a share of the light, most in its middle.
class RadiometryDisturbance {
 public:
  RadiometryDisturbance() = default;
  RadiometryDisturbance(EffectPlan& plan, int lines);

  /// Exponents of cos θ and 1/range that the device leaves, instead of the options'.
  [[nodiscard]] double incidence_exponent(const LidarOptions& lidar) const {
    return incidence_exponent_.value_or(lidar.incidence_exponent);
  }
  [[nodiscard]] double range_exponent(const LidarOptions& lidar) const {
    return range_exponent_.value_or(lidar.range_exponent);
  }

  /// Reflectivity that gloss adds to the board.
  [[nodiscard]] bool is_glossy() const { return gloss_ != 0.0; }
  [[nodiscard]] double gloss(double cos_incidence) const;

  [[nodiscard]] bool changes_intensity() const {
    return exponent_ != 1.0 || !line_gain_.empty() || saturates() || smudge_ != 0.0;
  }
  /// The intensity reported for what an undisturbed device would report along `direction` (unit,
  /// LiDAR frame), before noise.
  [[nodiscard]] double intensity(double intended, double power, const Eigen::Vector3d& direction,
                                 std::uint16_t line, double scale) const;

  [[nodiscard]] bool saturates() const { return saturation_m_ != 0.0; }
  /// Reported − true range of a saturated receiver.
  [[nodiscard]] double saturation_error_m(double power) const;

 private:
  std::optional<double> incidence_exponent_;
  std::optional<double> range_exponent_;
  std::vector<double> line_gain_;
  double exponent_ = 1.0;
  double gloss_ = 0.0;
  double saturation_m_ = 0.0;
  double smudge_ = 0.0;
  Eigen::Vector3d smudge_at_ = Eigen::Vector3d::UnitX();
};

}  // namespace lvcalib::simulation
