// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class RangeNear final : public CatalogueEffect {
 public:
  RangeNear()
      : CatalogueEffect(
            {.id = "range_near",
             .group = "LiDAR range",
             .title = "Near-range error",
             .physics = "Overlap of emitter and receiver is incomplete close to the sensor.",
             .formula = "dr = a exp(-r/r0)",
             .source = "HDL-64E S3 manual",
             .discriminating_pose = "a board below 1.5 m beside one beyond 3 m",
             .needs = {}},
            {{.name = "a",
              .unit = "mm",
              .unit_in_si = 1e-3,
              .size_of_interest = 5e-3,
              .prior_sigma = 0.1}}) {}

  [[nodiscard]] std::vector<double> shapes(const MeasurementTable&) const override {
    return {0.3, 0.6, 1.2, 2.4};
  }
  [[nodiscard]] std::string shape_name() const override { return "decay length (m)"; }

  void lidar(const BeamPoint& beam, const MeasurementTable& /*table*/, double shape,
             std::span<Eigen::Vector3d> by) const override {
    by[0] = std::exp(-beam.range_m / shape) * beam.direction;
  }
};

}  // namespace

EffectPtr make_range_near() {
  return std::make_shared<RangeNear>();
}

}  // namespace lvcalib
