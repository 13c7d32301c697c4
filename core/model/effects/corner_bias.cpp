// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class CornerBias final : public CatalogueEffect {
 public:
  CornerBias()
      : CatalogueEffect(
            {.id = "corner_bias",
             .group = "camera",
             .title = "Corner bias",
             .physics =
                 "The corner detector is drawn outwards or inwards, seen from the tag's centre.",
             .formula = "corners move by b away from the tag's centre in the image",
             .source = "MacKinnon 2023; measured on rendered tags",
             .discriminating_pose =
                 "boards at several distances: a print error in mm shrinks with the "
                 "distance, this does not",
             .needs = {.tags = true}},
            {{.name = "b", .unit = "px", .size_of_interest = 0.05, .prior_sigma = 2.0}}) {}

  void camera(const CornerRow& row, const Eigen::Vector2d& /*normalized*/, const Camera& /*camera*/,
              double /*shape*/, std::span<Eigen::Vector2d> by) const override {
    by[0] = image_direction_from_tag(row);
  }
};

}  // namespace

EffectPtr make_corner_bias() {
  return std::make_shared<CornerBias>();
}

}  // namespace lvcalib
