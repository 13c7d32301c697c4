// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

// Where all white print returns the same power, within 0.1 %, there is one limit to try.
constexpr double kSamePower = 1e-3;
// Limits tried over the powers that occur: a quarter apart at distances of 1.5 to 4 m (ln P spans
// 2), and no more than are tried without a sieve. The best is refined.
constexpr int kLimits = 8;

class ReceiverSaturation final : public CatalogueEffect {
 public:
  ReceiverSaturation()
      : CatalogueEffect(
            {.id = "receiver_saturation",
             .group = "radiometry",
             .title = "Receiver saturation",
             .physics = "Echoes above a certain power are clipped: bright print near the LiDAR "
                        "reads darker than it is, its edges lie off, and its range is wrong.",
             .formula = "x = ln(P/Ps) where the power P exceeds Ps, else 0; dr = a x, ln I -= c x",
             .source = "Mitka and Klapa 2025; Livox HAP and Mid-70 manuals",
             .discriminating_pose = "boards from close by to far away, square to the beam",
             .needs = {.intensity = true}},
            {{"a", "mm", 1e-3, 2e-3, 0.05}, {"c", "1", 1.0, 0.2, 1.0, 0.0}}) {}

  // From a receiver that clips all white print to one that clips the brightest alone.
  [[nodiscard]] std::vector<double> shapes(const MeasurementTable& table) const override {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const RangeRow& row : table.range) {
      if (row.print != Print::kWhite) continue;
      const double power = log_power(row.beam.range_m, row.beam.incidence_rad);
      low = std::min(low, power);
      high = std::max(high, power);
    }
    if (!(high - low > kSamePower)) return {0.0};
    std::vector<double> out;
    for (int k = 0; k < kLimits; ++k) out.push_back(low + (high - low) * k / kLimits);
    return out;
  }
  [[nodiscard]] std::string shape_name() const override { return "ln Ps, of white at 3 m"; }
  [[nodiscard]] bool is_about_prints() const override { return true; }

  void lidar(const BeamPoint& beam, const MeasurementTable& table, double shape,
             std::span<Eigen::Vector3d> by) const override {
    const double black = reflectivity_of_black(table, shape);
    by[0] = excess(beam, reflectivity(white_share(beam), black), shape) * beam.direction;
  }

  // Beside the scene's levels, which are those of clipped print in the board's middle: what a
  // mixture of white and black reads if it is clipped as a whole, over the mixture of the levels.
  void intensity(const IntensityRow& row, const MeasurementTable& table, double shape,
                 std::span<double> by) const override {
    const TableScene& scene = table.scenes[static_cast<std::size_t>(row.beam.scene)];
    const double middle = log_power(scene.middle_range_m, scene.middle_incidence_rad) - shape;
    const double black = reflectivity_of_black(table, shape);
    const double white_level = std::exp(-std::max(0.0, middle));
    const double black_level = black * std::exp(-std::max(0.0, middle + std::log(black)));
    const double share = white_share(row.beam);
    const double seen = reflectivity(share, black);
    by[1] = std::log(seen) - excess(row.beam, seen, shape) -
            std::log(black_level + (white_level - black_level) * share);
  }

 private:
  // The prediction goes on from where the print was looked up, and may overshoot.
  static double white_share(const BeamPoint& beam) { return std::clamp(beam.white, 0.0, 1.0); }

  static double reflectivity(double white, double black) { return black + (1.0 - black) * white; }

  // Beside white. The usual levels are those of the usual scene, whose white may be clipped.
  static double reflectivity_of_black(const MeasurementTable& table, double shape) {
    return std::exp(-std::max(0.0, table.log_contrast) -
                    std::max(0.0, table.usual_log_power - shape));
  }

  // ln(P/Ps) where the receiver saturates.
  static double excess(const BeamPoint& beam, double reflectivity, double shape) {
    return std::max(0.0,
                    log_power(beam.range_m, beam.incidence_rad) + std::log(reflectivity) - shape);
  }
};

}  // namespace

EffectPtr make_receiver_saturation() {
  return std::make_shared<ReceiverSaturation>();
}

}  // namespace lvcalib
