// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class PrintScale final : public CatalogueEffect {
 public:
  PrintScale()
      : CatalogueEffect({.id = "print_scale",
                         .group = "board",
                         .title = "Print scale",
                         .physics = "The print is larger or smaller than drawn, or not square.",
                         .formula = "x += (s+a) x + h y, y += (s-a) y + h x",
                         .source = "printers measured at up to 0.5 %",
                         .discriminating_pose = "measure the print with a ruler",
                         .needs = {}},
                        alike({.name = "scale",
                               .unit = "ppm",
                               .unit_in_si = 1e-6,
                               .size_of_interest = 500e-6,
                               .prior_sigma = 0.02},
                              {"anisotropy", "shear"})) {}

  // A rule on the print knows its size better than printers in general are known.
  [[nodiscard]] std::vector<EffectParameter> parameters(
      const MeasurementTable& table) const override {
    std::vector<EffectParameter> out = CatalogueEffect::parameters(table);
    if (table.target.size_sigma > 0.0) out.front().prior_sigma = table.target.size_sigma;
    return out;
  }

  void board(const PrintPoint& point, const Target& target, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    const Eigen::Vector2d p = point.board_m - target.outline().center_m();
    by[0].head<2>() = p;
    by[1].head<2>() = Eigen::Vector2d(p.x(), -p.y());
    by[2].head<2>() = Eigen::Vector2d(p.y(), p.x());
  }
};

}  // namespace

EffectPtr make_print_scale() {
  return std::make_shared<PrintScale>();
}

}  // namespace lvcalib
