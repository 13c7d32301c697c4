// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class EncoderEccentricity final : public CatalogueEffect {
 public:
  EncoderEccentricity()
      : CatalogueEffect({.id = "encoder_eccentricity",
                         .group = "LiDAR angle",
                         .title = "Encoder eccentricity",
                         .physics = "The scale disc of the encoder is not centred on the axis.",
                         .formula = "daz = a sin az + b cos az",
                         .source = "Lichti and Licht 2006",
                         .discriminating_pose = "boards all around the LiDAR",
                         .needs = {}},
                        {{.name = "a",
                          .unit = "mrad",
                          .unit_in_si = 1e-3,
                          .size_of_interest = 0.3e-3,
                          .prior_sigma = 0.02,
                          .device_fault = DeviceFault::kEccentricitySine},
                         {.name = "b",
                          .unit = "mrad",
                          .unit_in_si = 1e-3,
                          .size_of_interest = 0.3e-3,
                          .prior_sigma = 0.02,
                          .device_fault = DeviceFault::kEccentricityCosine}}) {}

  void lidar(const BeamPoint& beam, const MeasurementTable& /*table*/, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    const auto axes = angle_axes(beam);
    const double across = std::cos(beam.elevation_rad);
    by[0] = std::sin(beam.azimuth_rad) * across * axes.azimuth_m;
    by[1] = std::cos(beam.azimuth_rad) * across * axes.azimuth_m;
  }
};

}  // namespace

EffectPtr make_encoder_eccentricity() {
  return std::make_shared<EncoderEccentricity>();
}

}  // namespace lvcalib
