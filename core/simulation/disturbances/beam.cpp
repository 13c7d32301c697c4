// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/disturbances/beam.h"

#include <cmath>
#include <numbers>

#include "simulation/printed_board.h"

namespace lvcalib::simulation {
namespace {

// The exponent whose power mean of black and white reaches half of both at the wanted share of
// white. The share falls as the exponent grows.
double exponent_for(double white_share) {
  const double black = PrintedBoard::kBlack / PrintedBoard::kWhite;
  const double middle = 0.5 * (1.0 + black);
  double low = 0.01;
  double high = 50.0;
  for (int i = 0; i < 60; ++i) {
    const double q = 0.5 * (low + high);
    const double share = (std::pow(middle, q) - std::pow(black, q)) / (1.0 - std::pow(black, q));
    (share > white_share ? low : high) = q;
  }
  return 0.5 * (low + high);
}

}  // namespace

BeamDisturbance::BeamDisturbance(EffectPlan& plan, const LidarOptions& lidar)
    : edge_shift_m_(plan.si("boundary_bias")),
      range_pull_(plan.si("boundary_range_pull", 1.0)),
      lag_s_(plan.si("detector_lag")) {
  set_divergence(plan, lidar);
  if (const double kappa = plan.si("blooming"); kappa != 0.0) {
    const double sigmas = kappa * std::log(PrintedBoard::kWhite / PrintedBoard::kBlack);
    mean_exponent_ = exponent_for(0.5 * std::erfc(sigmas / std::numbers::sqrt2));
    plan.note("blooming", "power_mean_exponent", mean_exponent_);
  }
  // The print appears shifted one way if the light comes from the other.
  offset_horizontal_rad_ = -plan.si("footprint_offset");
  offset_vertical_rad_ =
      offset_horizontal_rad_ * plan.random("footprint_offset").uniform(-0.5, 0.5);
  plan.note("footprint_offset", "vertical_mrad", -1e3 * offset_vertical_rad_);
}

void BeamDisturbance::set_divergence(EffectPlan& plan, const LidarOptions& lidar) {
  if (plan.has("beam_divergence")) {
    horizontal_mrad_ = 1e3 * plan.si("beam_divergence");
    vertical_mrad_ = horizontal_mrad_;
  }
  if (!plan.has("footprint_anisotropy")) return;
  const double difference = 1e3 * plan.si("footprint_anisotropy");
  // A beam too narrow for the difference is widened to a line.
  const double mean =
      std::max(0.5 * (horizontal_mrad(lidar) + vertical_mrad(lidar)), 0.5 * std::abs(difference));
  horizontal_mrad_ = mean + 0.5 * difference;
  vertical_mrad_ = mean - 0.5 * difference;
  plan.note("footprint_anisotropy", "horizontal_mrad", *horizontal_mrad_);
  plan.note("footprint_anisotropy", "vertical_mrad", *vertical_mrad_);
}

std::array<BeamDisturbance::Lag, 2> BeamDisturbance::lags() const {
  if (lag_s_ == 0.0) return {{{1.0, 0.0}, {0.0, 0.0}}};
  const double root = std::numbers::sqrt2;
  return {
      {{0.25 * (2.0 + root), (2.0 - root) * lag_s_}, {0.25 * (2.0 - root), (2.0 + root) * lag_s_}}};
}

}  // namespace lvcalib::simulation
