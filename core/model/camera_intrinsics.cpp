// SPDX-License-Identifier: BSD-3-Clause
#include "model/camera_intrinsics.h"

#include <array>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

constexpr std::array<const char*, 12> kNames{"fx", "fy", "cx", "cy", "k1", "k2",
                                             "p1", "p2", "k3", "k4", "k5", "k6"};

std::vector<EffectParameter> intrinsics() {
  std::vector<EffectParameter> out;
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    // Half a pixel of what is told in pixels, as of an error of the intrinsics.
    const bool in_pixels = k < 4;
    out.push_back({.name = kNames[k],
                   .unit = in_pixels ? "px" : "1",
                   .size_of_interest = in_pixels ? 0.5 : 1e-3,
                   .prior_sigma = in_pixels ? 100.0 : 1.0});
  }
  return out;
}

class CameraIntrinsics final : public CatalogueEffect {
 public:
  CameraIntrinsics()
      : CatalogueEffect({.id = "camera_intrinsics",
                         .group = "camera",
                         .title = "Camera intrinsics",
                         .physics = "Any of the intrinsics differ from those in use.",
                         .formula = "du, dv = derivatives of the projection",
                         .source = "derived",
                         .discriminating_pose = "boards in all corners of the image",
                         .needs = {}},
                        intrinsics()) {}

  void camera(const CornerRow& /*row*/, const Eigen::Vector2d& normalized, const Camera& camera,
              double /*shape*/, std::span<Eigen::Vector2d> by) const override {
    Eigen::Matrix<double, 2, 12> by_intrinsics;
    const auto pixel = camera.project(normalized.homogeneous(), nullptr, &by_intrinsics);
    for (std::size_t k = 0; k < by.size(); ++k) {
      by[k] = pixel ? Eigen::Vector2d(by_intrinsics.col(static_cast<Eigen::Index>(k)))
                    : Eigen::Vector2d::Zero();
    }
  }
};

}  // namespace

EffectPtr camera_intrinsics() {
  return std::make_shared<CameraIntrinsics>();
}

}  // namespace lvcalib
