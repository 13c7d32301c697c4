// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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
            {{.name = "a",
              .unit = "mm",
              .unit_in_si = 1e-3,
              .size_of_interest = 2e-3,
              .prior_sigma = 0.05},
             {.name = "c",
              .unit = "1",
              .size_of_interest = 0.2,
              .prior_sigma = 1.0,
              .lowest = 0.0}}) {}

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
  [[nodiscard]] bool follows_white() const override { return true; }

  void lidar(const BeamPoint& beam, const MeasurementTable& table, double shape,
             std::span<Eigen::Vector3d> by) const override {
    // No print is brighter than white.
    const double power = log_power(beam.range_m, beam.incidence_rad);
    if (power <= shape) return;
    by[0] = Echoes(beam, power, table, shape).mean_excess() * beam.direction;
  }

  // Beside the scene's levels, which are those of clipped print in the board's middle: what a
  // mixture of white and black reads if it is clipped as a whole, over the mixture of the levels.
  void intensity(const IntensityRow& row, const MeasurementTable& table, double shape,
                 std::span<double> by) const override {
    const TableScene& scene = table.scenes[static_cast<std::size_t>(row.beam.scene)];
    const double middle = log_power(scene.middle_range_m, scene.middle_incidence_rad) - shape;
    const double power = log_power(row.beam.range_m, row.beam.incidence_rad);
    const Echoes echoes(row.beam, power, table, shape);
    const double black = echoes.black();
    const double white_level = std::exp(-std::max(0.0, middle));
    const double black_level = black * std::exp(-std::max(0.0, middle + echoes.log_black()));
    by[1] = std::log(echoes.mean_reflectivity()) -
            std::log(black_level + (white_level - black_level) * white_share(row.beam));
  }

 private:
  // The prediction goes on from where the print was looked up, and may overshoot.
  static double white_share(const BeamPoint& beam) { return std::clamp(beam.white, 0.0, 1.0); }

  static double reflectivity(double white, double black) { return black + (1.0 - black) * white; }

  // ln of black's reflectivity beside white, whose level may be that of clipped white.
  static double log_reflectivity_of_black(int scene, const MeasurementTable& table, double shape) {
    const auto at = static_cast<std::size_t>(scene);
    if (at >= table.placed_by.levels.size()) return -std::max(0.0, table.log_contrast);
    const TableScene& s = table.scenes[at];
    return -std::max(0.0, log_contrast(table.placed_by.levels[at])) -
           std::max(0.0, log_power(s.middle_range_m, s.middle_incidence_rad) - shape);
  }

  // Echoes of one return's place that jitter makes see more or less white than their mean. Across
  // one straight edge a share Φ(z) of white in the whole blur is Φ((z + √q u)/√(1 − q)) in the
  // footprint, with u of the standard normal distribution and q the jitter's share of the blur's
  // variance. An echo is clipped before returns are averaged: what they show is integrated over
  // p = Φ(u) on either side of the limit by Gauss and Legendre's rule.
  class Echoes {
   public:
    // `power`: ln P of white print there.
    Echoes(const BeamPoint& beam, double power, const MeasurementTable& table, double shape)
        : log_black_(log_reflectivity_of_black(beam.scene, table, shape)),
          black_(std::exp(log_black_)),
          log_limit_(shape - power),
          limit_(std::exp(log_limit_)) {
      constexpr double kPlain = 1e-4;  // Print of one kind, to less than any noise.
      constexpr double kMost = 0.99;   // All of a blur being jitter has no slope.
      const double mean = white_share(beam);
      seen_ = reflectivity(mean, black_);
      const double q = std::min(beam.jitter_share, kMost);
      alike_ = limit_ >= 1.0 || !(q > 0.0) || mean < kPlain || mean > 1.0 - kPlain;
      if (alike_) return;
      jitter_ = std::sqrt(q);
      footprint_ = std::sqrt(1.0 - q);
      z_ = normal_quantile(mean);
      const double share = (limit_ - black_) / (1.0 - black_);
      if (!(share > 0.0)) return;
      below_ = normal_cdf((footprint_ * normal_quantile(share) - z_) / jitter_);
      // One return in ten thousand is none.
      if (below_ < kPlain) below_ = 0.0;
      if (below_ > 1.0 - kPlain) below_ = 1.0;
    }

    [[nodiscard]] double black() const { return black_; }
    [[nodiscard]] double log_black() const { return log_black_; }

    // What they show on average, beside unclipped white.
    [[nodiscard]] double mean_reflectivity() const {
      if (alike_) return std::min(seen_, limit_);
      double sum = (1.0 - below_) * limit_;
      if (below_ > 0.0) {
        for (std::size_t k = 0; k < kAt.size(); ++k)
          sum += below_ * kWeight[k] *
                 reflectivity_at(below_ == 1.0 ? places()[k] : normal_quantile(below_ * kAt[k]));
      }
      return sum;
    }

    // By how much ln P exceeds ln Ps on average, nothing where it does not.
    [[nodiscard]] double mean_excess() const {
      if (alike_) return std::max(0.0, std::log(seen_) - log_limit_);
      double sum = 0.0;
      if (below_ < 1.0) {
        for (std::size_t k = 0; k < kAt.size(); ++k) {
          const double above = reflectivity_at(
              below_ == 0.0 ? places()[k] : normal_quantile(below_ + (1.0 - below_) * kAt[k]));
          sum += (1.0 - below_) * kWeight[k] * (std::log(above) - log_limit_);
        }
      }
      return sum;
    }

   private:
    static constexpr std::array<double, 4> kAt{0.0694318442, 0.3300094782, 0.6699905218,
                                               0.9305681558};
    static constexpr std::array<double, 4> kWeight{0.1739274226, 0.3260725774, 0.3260725774,
                                                   0.1739274226};

    // u of the rule's places where all echoes lie on one side of the limit, as most do.
    static const std::array<double, 4>& places() {
      static const std::array<double, 4> u = [] {
        std::array<double, 4> out{};
        std::transform(kAt.begin(), kAt.end(), out.begin(), normal_quantile);
        return out;
      }();
      return u;
    }

    [[nodiscard]] double reflectivity_at(double u) const {
      return reflectivity(normal_cdf((z_ + jitter_ * u) / footprint_), black_);
    }

    double log_black_;
    double black_;
    double log_limit_;
    double limit_;
    double seen_ = 0.0;    // By their mean.
    bool alike_ = false;   // None sees more than the others, or none is clipped.
    double jitter_ = 0.0;  // Shares of the blur's width.
    double footprint_ = 1.0;
    double z_ = 0.0;
    double below_ = 0.0;  // Share of echoes that are not clipped.
  };
};

}  // namespace

EffectPtr make_receiver_saturation() {
  return std::make_shared<ReceiverSaturation>();
}

}  // namespace lvcalib
