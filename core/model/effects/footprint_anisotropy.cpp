// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class FootprintAnisotropy final : public CatalogueEffect {
 public:
  FootprintAnisotropy()
      : CatalogueEffect(
            {.id = "footprint_anisotropy",
             .group = "beam",
             .title = "Elliptic footprint",
             .physics = "The footprint is wider along one axis of the LiDAR.",
             .formula = "dd = -r² (γh² sin²ψ' + γv² cos²ψ') / 2R",
             .source = "Livox Avia manual",
             .breaker = "circles far away",
             .needs = {.circles = true, .intensity = true}},
            {{"γh²", "mrad²", 1e-6, 4e-6, 1e-4, 0.0}, {"γv²", "mrad²", 1e-6, 4e-6, 1e-4, 0.0}}) {}

  void edge(const BoundaryRow& row, const MeasurementTable& /*table*/, double /*shape*/,
            std::span<double> by) const override {
    const Eigen::Vector2d n = lidar_angle_of(row);
    const double scale = edge_curvature(row);
    // It is the spread along the edge that meets the curve: where the edge runs upright, the
    // vertical one.
    by[0] = scale * n.y() * n.y();
    by[1] = scale * n.x() * n.x();
  }
};

}  // namespace

EffectPtr make_footprint_anisotropy() {
  return std::make_shared<FootprintAnisotropy>();
}

}  // namespace lvcalib
