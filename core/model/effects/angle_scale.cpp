// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class AngleScale final : public CatalogueEffect {
 public:
  AngleScale()
      : CatalogueEffect({.id = "angle_scale",
                         .group = "LiDAR angle",
                         .title = "Scale of the angles",
                         .physics = "Azimuth or elevation is read with a wrong scale.",
                         .formula = "daz = s1 az, del = s2 el",
                         .source = "Lichti and Licht 2006",
                         .discriminating_pose = "boards at the edges of the field of view",
                         .needs = {}},
                        {{.name = "azimuth",
                          .unit = "ppm",
                          .unit_in_si = 1e-6,
                          .size_of_interest = 500e-6,
                          .prior_sigma = 0.02,
                          .device_fault = DeviceFault::kAzimuthScale},
                         {.name = "elevation",
                          .unit = "ppm",
                          .unit_in_si = 1e-6,
                          .size_of_interest = 500e-6,
                          .prior_sigma = 0.02,
                          .device_fault = DeviceFault::kElevationScale}}) {}

  void lidar(const BeamPoint& beam, const MeasurementTable& /*table*/, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    const auto axes = angle_axes(beam);
    by[0] = beam.azimuth_rad * std::cos(beam.elevation_rad) * axes.azimuth_m;
    by[1] = beam.elevation_rad * axes.elevation_m;
  }
};

}  // namespace

EffectPtr make_angle_scale() {
  return std::make_shared<AngleScale>();
}

}  // namespace lvcalib
