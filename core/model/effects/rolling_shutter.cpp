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
             .physics = "Image rows are exposed one after the other while the camera turns.",
             .formula = "du = y/H (v (1+x²) + w x y), dv = y/H (v x y + w (1+y²)), y/H the row",
             .source = "derived",
             .discriminating_pose = "let the rig rest",
             .needs = {}},
            alike({.name = "v", .unit = "px", .size_of_interest = 0.3, .prior_sigma = 50.0},
                  {"w"})) {}

  void camera(const CornerRow& row, const Eigen::Vector2d& normalized, const Camera& camera,
              double /*shape*/, std::span<Eigen::Vector2d> by) const override {
    // The pose is that of the first row, as the formula has it.
    const double share = row.pixel.y() / camera.height_px;
    const double x = normalized.x();
    const double y = normalized.y();
    Eigen::Matrix<double, 2, 3> by_point;  // The lens bends what the turn moves.
    if (!camera.project({x, y, 1.0}, &by_point)) return;
    const Eigen::Vector2d v(1.0 + x * x, x * y);
    const Eigen::Vector2d w(x * y, 1.0 + y * y);
    by[0] = share / camera.fx * by_point.leftCols<2>() * v;
    by[1] = share / camera.fy * by_point.leftCols<2>() * w;
  }
};

}  // namespace

EffectPtr make_rolling_shutter() {
  return std::make_shared<RollingShutter>();
}

}  // namespace lvcalib
