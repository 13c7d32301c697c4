// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class EncoderLag final : public CatalogueEffect {
 public:
  EncoderLag()
      : CatalogueEffect({.id = "encoder_lag",
                         .group = "LiDAR angle",
                         .title = "Encoder lag",
                         .physics = "The angle is read a little before or after the pulse: the "
                                    "beam is shifted along its scan.",
                         .formula = "direction shifted by τ ω",
                         .source = "Glennie and Lichti 2011",
                         .discriminating_pose = "scans that cross the board in several directions",
                         .needs = {.time = true}},
                        {{.name = "τ",
                          .unit = "µs",
                          .unit_in_si = 1e-6,
                          .size_of_interest = 2e-6,
                          .prior_sigma = 1e-3}}) {}

  void lidar(const BeamPoint& beam, const MeasurementTable& /*table*/, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    const auto axes = angle_axes(beam);
    by[0] = beam.scan_rad_s.x() * axes.azimuth_m + beam.scan_rad_s.y() * axes.elevation_m;
  }
};

}  // namespace

EffectPtr make_encoder_lag() {
  return std::make_shared<EncoderLag>();
}

}  // namespace lvcalib
