// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class IntrinsicsError final : public CatalogueEffect {
 public:
  IntrinsicsError()
      : CatalogueEffect(
            {.id = "intrinsics_error",
             .group = "camera",
             .title = "Intrinsics error",
             .physics = "Focal length or principal point differ from the intrinsics file.",
             .formula = "du = δf x + δcx, dv = δf y + δcy",
             .source = "mrcal; Abraham and Förstner",
             .discriminating_pose = "boards in all corners of the image and at several distances",
             .needs = {},
             .of_intrinsics = true},
            alike({.name = "δf", .unit = "px", .size_of_interest = 0.5, .prior_sigma = 100.0},
                  {"δcx", "δcy"})) {}

  void camera(const CornerRow& /*row*/, const Eigen::Vector2d& normalized, const Camera& /*camera*/,
              double /*shape*/, std::span<Eigen::Vector2d> by) const override {
    by[0] = normalized;
    by[1] = Eigen::Vector2d::UnitX();
    by[2] = Eigen::Vector2d::UnitY();
  }
};

}  // namespace

EffectPtr make_intrinsics_error() {
  return std::make_shared<IntrinsicsError>();
}

}  // namespace lvcalib
