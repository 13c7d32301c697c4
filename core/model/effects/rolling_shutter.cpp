// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class RollingShutter final : public CatalogueEffect {
 public:
  RollingShutter()
      : CatalogueEffect(
            {.id = "rolling_shutter",
             .group = "time",
             .title = "Rolling shutter",
             .physics = "Image rows are exposed one after the other while something moves.",
             .formula = "du = v y/H, dv = w y/H",
             .source = "derived",
             .breaker = "let the rig rest",
             .needs = {}},
            {{"v", "px", 1.0, 0.3, 50.0}, {"w", "px", 1.0, 0.3, 50.0}}) {}

  void camera(const CornerRow& row, const Eigen::Vector2d& /*normalized*/, const Camera& camera,
              double /*shape*/, std::span<Eigen::Vector2d> by) const override {
    const double share = row.pixel.y() / camera.height_px - 0.5;
    by[0] = share * Eigen::Vector2d::UnitX();
    by[1] = share * Eigen::Vector2d::UnitY();
  }
};

}  // namespace

EffectPtr make_rolling_shutter() {
  return std::make_shared<RollingShutter>();
}

}  // namespace lvcalib
