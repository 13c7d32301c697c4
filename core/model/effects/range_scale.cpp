// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class RangeScale final : public CatalogueEffect {
 public:
  RangeScale()
      : CatalogueEffect(
            {.id = "range_scale",
             .group = "LiDAR range",
             .title = "Range scale",
             .physics = "Ranges are proportionally off: wrong clock frequency or refractive index.",
             .formula = "dr = m r",
             .source = "Lichti and Licht 2006",
             .discriminating_pose = "measure the printed board: a wrong print scale looks the same",
             .needs = {}},
            {{.name = "m",
              .unit = "ppm",
              .unit_in_si = 1e-6,
              .size_of_interest = 500e-6,
              .prior_sigma = 5e-3,
              .device_fault = DeviceFault::kRangeScale}}) {}

  void lidar(const BeamPoint& beam, const MeasurementTable& /*table*/, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    by[0] = beam.range_m * beam.direction;
  }
};

}  // namespace

EffectPtr make_range_scale() {
  return std::make_shared<RangeScale>();
}

}  // namespace lvcalib
