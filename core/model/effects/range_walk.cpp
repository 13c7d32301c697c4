// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class RangeWalk final : public CatalogueEffect {
 public:
  RangeWalk()
      : CatalogueEffect(
            {.id = "range_walk",
             .group = "LiDAR range",
             .title = "Range walk",
             .physics = "Weak echoes cross the detection threshold later (or earlier), so that "
                        "dark print reads a different range than white print.",
             .formula =
                 "dr = a g(P), g = 0 for the usual white and 1 for the usual black, linear in ln P",
             .source = "Livox HAP and Mid-70 manuals; Laconte 2019",
             .breaker = "boards at two distances with the same print",
             .needs = {.intensity = true}},
            {{"a", "mm", 1e-3, 2e-3, 0.05}}) {}

  void lidar(const BeamPoint& beam, const MeasurementTable& /*table*/, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    by[0] = beam.darkness * beam.direction;
  }
};

}  // namespace

EffectPtr make_range_walk() {
  return std::make_shared<RangeWalk>();
}

}  // namespace lvcalib
