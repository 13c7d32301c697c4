// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class DistortionResidual final : public CatalogueEffect {
 public:
  DistortionResidual()
      : CatalogueEffect(
            {.id = "distortion_residual",
             .group = "camera",
             .title = "Residual distortion",
             .physics = "The lens distorts differently than the intrinsics file says.",
             .formula = "dx = x (k ρ²) + tangential (p1, p2)",
             .source = "mrcal",
             .discriminating_pose = "boards in the corners of the image",
             .needs = {},
             .of_intrinsics = true},
            {{.name = "k", .unit = "1", .size_of_interest = 5e-4, .prior_sigma = 0.5},
             {.name = "p1", .unit = "1", .size_of_interest = 2e-4, .prior_sigma = 0.1},
             {.name = "p2", .unit = "1", .size_of_interest = 2e-4, .prior_sigma = 0.1}}) {}

  void camera(const CornerRow& /*row*/, const Eigen::Vector2d& normalized, const Camera& camera,
              double /*shape*/, std::span<Eigen::Vector2d> by) const override {
    const double x = normalized.x();
    const double y = normalized.y();
    const double rho2 = normalized.squaredNorm();
    const Eigen::Vector2d f(camera.fx, camera.fy);
    by[0] = rho2 * f.cwiseProduct(normalized);
    by[1] = f.cwiseProduct(Eigen::Vector2d(2 * x * y, rho2 + 2 * y * y));
    by[2] = f.cwiseProduct(Eigen::Vector2d(rho2 + 2 * x * x, 2 * x * y));
  }
};

}  // namespace

EffectPtr make_distortion_residual() {
  return std::make_shared<DistortionResidual>();
}

}  // namespace lvcalib
