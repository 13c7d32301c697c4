// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <boost/math/distributions/normal.hpp>

#include "base/statistics.h"
#include "model/catalogue_effect.h"
#include "model/effect_rows.h"

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
    by[0] = clipped(beam, table, shape).excess * beam.direction;
  }

  // Beside the scene's levels, which are those of clipped print in the board's middle: what a
  // mixture of white and black reads if it is clipped as a whole, over the mixture of the levels.
  void intensity(const IntensityRow& row, const MeasurementTable& table, double shape,
                 std::span<double> by) const override {
    const TableScene& scene = table.scenes[static_cast<std::size_t>(row.beam.scene)];
    const double middle = log_power(scene.middle_range_m, scene.middle_incidence_rad) - shape;
    const double black = reflectivity_of_black(row.beam.scene, table, shape);
    const double white_level = std::exp(-std::max(0.0, middle));
    const double black_level = black * std::exp(-std::max(0.0, middle + std::log(black)));
    by[1] = std::log(clipped(row.beam, table, shape).reflectivity) -
            std::log(black_level + (white_level - black_level) * white_share(row.beam));
  }

 private:
  // The prediction goes on from where the print was looked up, and may overshoot.
  static double white_share(const BeamPoint& beam) { return std::clamp(beam.white, 0.0, 1.0); }

  static double reflectivity(double white, double black) { return black + (1.0 - black) * white; }

  // Beside white, whose level may be that of clipped white.
  static double reflectivity_of_black(int scene, const MeasurementTable& table, double shape) {
    const auto at = static_cast<std::size_t>(scene);
    if (at >= table.placed_by.levels.size()) return std::exp(-std::max(0.0, table.log_contrast));
    const TableScene& s = table.scenes[at];
    return std::exp(-std::max(0.0, log_contrast(table.placed_by.levels[at])) -
                    std::max(0.0, log_power(s.middle_range_m, s.middle_incidence_rad) - shape));
  }

  // What returns show on average beside unclipped white, and by how much ln P exceeds ln Ps.
  struct Clipped {
    double reflectivity = 1.0;
    double excess = 0.0;
  };

  // An echo is clipped before returns are averaged, and the jitter lets single ones see more and
  // less white than their mean. Across one straight edge a share Φ(z) of white in the whole blur is
  // Φ((z + √q u)/√(1 − q)) in the footprint, with u of the standard normal distribution and q the
  // jitter's share of the blur's variance. Integrated over p = Φ(u) on either side of the limit by
  // Gauss and Legendre's rule.
  static Clipped clipped(const BeamPoint& beam, const MeasurementTable& table, double shape) {
    constexpr std::array<double, 4> kAt{0.0694318442, 0.3300094782, 0.6699905218, 0.9305681558};
    constexpr std::array<double, 4> kWeight{0.1739274226, 0.3260725774, 0.3260725774, 0.1739274226};
    constexpr double kPlain = 1e-4;  // Print of one kind, to less than any noise.
    constexpr double kMost = 0.99;   // All of a blur being jitter has no slope.
    const double black = reflectivity_of_black(beam.scene, table, shape);
    const double log_limit = shape - log_power(beam.range_m, beam.incidence_rad);
    const double limit = std::exp(log_limit);
    const double mean = white_share(beam);
    const double seen = reflectivity(mean, black);
    if (limit >= 1.0) return {seen, 0.0};
    const double q = std::min(beam.jitter_share, kMost);
    if (!(q > 0.0) || mean < kPlain || mean > 1.0 - kPlain)
      return {std::min(seen, limit), std::max(0.0, std::log(seen) - log_limit)};
    const boost::math::normal normal;
    const double z = boost::math::quantile(normal, mean);
    const auto reflectivity_at = [&](double p) {
      const double u = boost::math::quantile(normal, p);
      return reflectivity(normal_cdf((z + std::sqrt(q) * u) / std::sqrt(1.0 - q)), black);
    };
    double below = 0.0;  // Share of returns that are not clipped.
    if (const double share = (limit - black) / (1.0 - black); share > 0.0) {
      const double u = std::sqrt(1.0 - q) * boost::math::quantile(normal, share) - z;
      below = normal_cdf(u / std::sqrt(q));
      // One return in ten thousand is none.
      if (below < kPlain) below = 0.0;
      if (below > 1.0 - kPlain) below = 1.0;
    }
    Clipped out{(1.0 - below) * limit, 0.0};
    for (std::size_t k = 0; k < kAt.size(); ++k) {
      if (below > 0.0) out.reflectivity += below * kWeight[k] * reflectivity_at(below * kAt[k]);
      if (below < 1.0) {
        const double above = reflectivity_at(below + (1.0 - below) * kAt[k]);
        out.excess += (1.0 - below) * kWeight[k] * (std::log(above) - log_limit);
      }
    }
    return out;
  }
};

}  // namespace

EffectPtr make_receiver_saturation() {
  return std::make_shared<ReceiverSaturation>();
}

}  // namespace lvcalib
