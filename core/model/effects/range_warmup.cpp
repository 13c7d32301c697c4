// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class RangeWarmup final : public CatalogueEffect {
 public:
  RangeWarmup()
      : CatalogueEffect({.id = "range_warmup",
                         .group = "LiDAR range",
                         .title = "Warm-up drift",
                         .physics = "The range drifts while electronics warm up.",
                         .formula = "dr = b exp(-t/τ) over the order of the scenes",
                         .source = "Glennie and Lichti 2011",
                         .discriminating_pose = "repeat the first scene at the end",
                         .needs = {}},
                        {{.name = "b",
                          .unit = "mm",
                          .unit_in_si = 1e-3,
                          .size_of_interest = 2e-3,
                          .prior_sigma = 0.05}}) {}

  [[nodiscard]] std::vector<double> shapes(const MeasurementTable&) const override {
    return {0.15, 0.4, 1.0};
  }
  [[nodiscard]] std::string shape_name() const override { return "decay (share of the session)"; }

  void lidar(const BeamPoint& beam, const MeasurementTable& table, double shape,
             std::span<Eigen::Vector3d> by) const override {
    const double clock = table.scenes[static_cast<std::size_t>(beam.scene)].clock;
    by[0] = std::exp(-clock / shape) * beam.direction;
  }
};

}  // namespace

EffectPtr make_range_warmup() {
  return std::make_shared<RangeWarmup>();
}

}  // namespace lvcalib
