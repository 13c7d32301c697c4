// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class BeamOriginOffset final : public CatalogueEffect {
 public:
  BeamOriginOffset()
      : CatalogueEffect(
            {.id = "beam_origin_offset",
             .group = "LiDAR angle",
             .title = "Offset of the beam's origin",
             .physics = "Beams do not start at the origin of the frame, so that their direction "
                        "error falls with the range.",
             .formula = "angle error o/r",
             .source = "NISTIR 6922; VLS-128 manual",
             .discriminating_pose = "boards below 2 m beside boards beyond 4 m",
             .needs = {}},
            {{.name = "horizontal",
              .unit = "mm",
              .unit_in_si = 1e-3,
              .size_of_interest = 2e-3,
              .prior_sigma = 0.05,
              .device_fault = DeviceFault::kOriginAcross},
             {.name = "vertical",
              .unit = "mm",
              .unit_in_si = 1e-3,
              .size_of_interest = 2e-3,
              .prior_sigma = 0.05,
              .device_fault = DeviceFault::kOriginUp}}) {}

  void lidar(const BeamPoint& beam, const MeasurementTable& /*table*/, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    const auto axes = angle_axes(beam);
    by[0] = axes.azimuth_m / beam.range_m;
    by[1] = axes.elevation_m / beam.range_m;
  }
};

}  // namespace

EffectPtr make_beam_origin_offset() {
  return std::make_shared<BeamOriginOffset>();
}

}  // namespace lvcalib
