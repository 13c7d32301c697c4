// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class AngleZero final : public CatalogueEffect {
 public:
  AngleZero()
      : CatalogueEffect({.id = "angle_zero",
                         .group = "LiDAR angle",
                         .title = "Zero of the angles",
                         .physics = "The zero of azimuth or elevation is off. It is the same as a "
                                    "turned LiDAR: part of the extrinsic by definition.",
                         .formula = "daz = a, del = b",
                         .source = "definition of the LiDAR frame",
                         .discriminating_pose = "none: not defined apart from the extrinsic",
                         .needs = {}},
                        alike({.name = "a",
                               .unit = "mrad",
                               .unit_in_si = 1e-3,
                               .size_of_interest = 0.5e-3,
                               .prior_sigma = 0.05},
                              {"b"})) {}
  [[nodiscard]] bool is_gauge() const override { return true; }

  void lidar(const BeamPoint& beam, const MeasurementTable& /*table*/, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    const auto axes = angle_axes(beam);
    by[0] = std::cos(beam.elevation_rad) * axes.azimuth_m;
    by[1] = axes.elevation_m;
  }
};

}  // namespace

EffectPtr make_angle_zero() {
  return std::make_shared<AngleZero>();
}

}  // namespace lvcalib
