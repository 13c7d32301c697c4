// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/disturbances/radiometry.h"

#include <algorithm>

#include "simulation/printed_board.h"

namespace lvcalib::simulation {
namespace {

constexpr double kRoughness = 0.15;
constexpr double kSmudgeRad = 0.1;  // One σ.
constexpr double kSaturationShare = 0.6;
constexpr double kWhitePower = PrintedBoard::kWhite / 9.0;  // At 3 m.
constexpr double kSaturationPower = kSaturationShare * kWhitePower;

}  // namespace

RadiometryDisturbance::RadiometryDisturbance(EffectPlan& plan, int lines)
    : exponent_(plan.si("intensity_nonlinearity", 1.0)),
      gloss_(plan.si("specular_lobe")),
      saturation_m_(plan.si("receiver_saturation")),
      smudge_(plan.si("x_window_smudge")) {
  if (plan.has("intensity_geometry")) {
    incidence_exponent_ = plan.si("intensity_geometry");
    range_exponent_ = 0.5 * *incidence_exponent_;
    plan.note("intensity_geometry", "range_exponent", *range_exponent_);
    Random random = plan.random("intensity_geometry");
    const auto deviations =
        plan.per_line("intensity_geometry", "line_gain_percent", 0.03, 0.01, lines, random);
    for (const double deviation : deviations) line_gain_.push_back(1.0 + deviation);
  }
  if (plan.has("x_window_smudge")) {
    Random random = plan.random("x_window_smudge");
    const double azimuth = random.uniform(-0.17, 0.17);
    const double elevation = random.uniform(-0.1, 0.1);
    smudge_at_ = {std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
                  std::sin(elevation)};
    plan.note("x_window_smudge", "center_rad", {azimuth, elevation});
  }
  plan.note("specular_lobe", "roughness", kRoughness);
  plan.note("receiver_saturation", "saturation_power", kSaturationPower);
}

double RadiometryDisturbance::gloss(double cos_incidence) const {
  const double square = std::max(1e-4, cos_incidence * cos_incidence);
  const double tan_square = (1.0 - square) / square;
  return gloss_ * std::exp(-tan_square / (kRoughness * kRoughness)) / (square * square);
}

double RadiometryDisturbance::intensity(double intended, double power,
                                        const Eigen::Vector3d& direction, std::uint16_t line,
                                        double scale) const {
  double value = intended;
  if (smudge_ != 0.0) {
    const double off = (direction - smudge_at_).norm() / kSmudgeRad;
    value *= 1.0 - smudge_ * std::exp(-0.5 * off * off);
  }
  if (!line_gain_.empty()) value *= line_gain_[line];
  if (saturates() && power > kSaturationPower) value *= kSaturationPower / power;
  if (exponent_ != 1.0) value = scale * std::pow(std::max(0.0, value) / scale, exponent_);
  return value;
}

double RadiometryDisturbance::saturation_error_m(double power) const {
  if (power <= kSaturationPower) return 0.0;
  return saturation_m_ * std::log(power / kSaturationPower) / -std::log(kSaturationShare);
}

}  // namespace lvcalib::simulation
