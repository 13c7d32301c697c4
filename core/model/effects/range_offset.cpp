// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class RangeOffset final : public CatalogueEffect {
 public:
  RangeOffset()
      : CatalogueEffect({.id = "range_offset",
                         .group = "LiDAR range",
                         .title = "Range offset",
                         .physics = "Every range is off by the same amount, for example by the "
                                    "internal delay or a wrong zero point.",
                         .formula = "dr = a",
                         .source = "Lichti and Licht 2006; HDL-64E S3 manual",
                         .discriminating_pose = "boards turned to ±40 degrees",
                         .needs = {}},
                        {{.name = "a",
                          .unit = "mm",
                          .unit_in_si = 1e-3,
                          .size_of_interest = 3e-3,
                          .prior_sigma = 0.05,
                          .device_fault = DeviceFault::kRangeOffset}}) {}

  void lidar(const BeamPoint& beam, const MeasurementTable& /*table*/, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    by[0] = beam.direction;
  }
};

}  // namespace

EffectPtr make_range_offset() {
  return std::make_shared<RangeOffset>();
}

}  // namespace lvcalib
