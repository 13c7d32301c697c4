// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class AxisWobble final : public CatalogueEffect {
 public:
  AxisWobble()
      : CatalogueEffect({.id = "axis_wobble",
                         .group = "LiDAR angle",
                         .title = "Collimation and axis errors",
                         .physics = "The beam is not square to the turning axis, or the axis is "
                                    "tilted against the mirror.",
                         .formula = "daz = c sec el + i tan el",
                         .source = "Lichti and Licht 2006",
                         .discriminating_pose = "boards high and low",
                         .needs = {}},
                        {{.name = "c",
                          .unit = "mrad",
                          .unit_in_si = 1e-3,
                          .size_of_interest = 0.5e-3,
                          .prior_sigma = 0.02},
                         {.name = "i",
                          .unit = "mrad",
                          .unit_in_si = 1e-3,
                          .size_of_interest = 0.5e-3,
                          .prior_sigma = 0.02,
                          .device_fault = DeviceFault::kAxisTilt}}) {}

  void lidar(const BeamPoint& beam, const MeasurementTable& /*table*/, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    const auto axes = angle_axes(beam);
    // daz cos el: the sec cancels, the tan becomes a sine.
    by[0] = axes.azimuth_m;
    by[1] = std::sin(beam.elevation_rad) * axes.azimuth_m;
  }
};

}  // namespace

EffectPtr make_axis_wobble() {
  return std::make_shared<AxisWobble>();
}

}  // namespace lvcalib
