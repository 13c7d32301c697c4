// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class RangeCyclic final : public CatalogueEffect {
 public:
  RangeCyclic()
      : CatalogueEffect(
            {.id = "range_cyclic",
             .group = "LiDAR range",
             .title = "Cyclic range error",
             .physics = "Crosstalk or phase measurement makes the range error a wave of the range.",
             .formula = "dr = a sin(2πr/U) + b cos(2πr/U)",
             .source = "Lichti and Licht 2006",
             .discriminating_pose = "a board turned so that its range spans two periods",
             .needs = {}},
            alike({.name = "a",
                   .unit = "mm",
                   .unit_in_si = 1e-3,
                   .size_of_interest = 0.7e-3,
                   .prior_sigma = 0.03},
                  {"b"})) {}

  [[nodiscard]] std::vector<double> shapes(const MeasurementTable& table) const override {
    return period_grid(table);
  }
  [[nodiscard]] std::string shape_name() const override { return "period (m)"; }

  void lidar(const BeamPoint& beam, const MeasurementTable& /*table*/, double shape,
             std::span<Eigen::Vector3d> by) const override {
    const double phase = 2.0 * std::numbers::pi * beam.range_m / shape;
    by[0] = std::sin(phase) * beam.direction;
    by[1] = std::cos(phase) * beam.direction;
  }
};

}  // namespace

EffectPtr make_range_cyclic() {
  return std::make_shared<RangeCyclic>();
}

}  // namespace lvcalib
