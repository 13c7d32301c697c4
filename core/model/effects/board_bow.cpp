// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class BoardBow final : public CatalogueEffect {
 public:
  BoardBow()
      : CatalogueEffect(
            {.id = "board_bow",
             .group = "board",
             .title = "Board bow",
             .physics = "The board is not flat: it bends or twists.",
             .formula = "z = kx (1-x²) + ky (1-y²) + kxy x y, x and y from -1 to 1",
             .source = "measured on foam boards",
             .discriminating_pose = "none needed: turn the board by 90 degrees to confirm",
             .needs = {}},
            alike({.name = "kx",
                   .unit = "mm",
                   .unit_in_si = 1e-3,
                   .size_of_interest = 0.5e-3,
                   .prior_sigma = 0.02},
                  {"ky", "kxy"})) {}

  void board(const PrintPoint& point, const Target& target, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    const Eigen::Vector2d p = on_unit_square(point.board_m, target);
    by[0].z() = 1.0 - p.x() * p.x();
    by[1].z() = 1.0 - p.y() * p.y();
    by[2].z() = p.x() * p.y();
  }
};

}  // namespace

EffectPtr make_board_bow() {
  return std::make_shared<BoardBow>();
}

}  // namespace lvcalib
