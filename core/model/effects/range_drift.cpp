// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class RangeDrift final : public CatalogueEffect {
 public:
  RangeDrift()
      : CatalogueEffect(
            {.id = "range_drift",
             .group = "LiDAR range",
             .title = "Drift within a scan",
             .physics = "The range drifts anew in every scan, as where the device is "
                        "switched on for it.",
             .formula = "dr = a τ (1 - exp(-t/τ)), t from the start of the scan",
             .source = "Glennie and Lichti 2011",
             .discriminating_pose = "let the device run before the scan; boards beside the middle, "
                                    "where motion looks different",
             .needs = {.time = true}},
            {{.name = "a",
              .unit = "mm/s",
              .unit_in_si = 1e-3,
              .size_of_interest = 2e-3,
              .prior_sigma = 0.5}}) {}

  // From a tenth of a scan to so long that the drift is steady.
  [[nodiscard]] std::vector<double> shapes(const MeasurementTable& table) const override {
    double last = 0.0;
    for (const RangeRow& row : table.range) last = std::max(last, row.beam.time_s);
    if (!(last > 0.0)) last = 1.0;
    return {0.1 * last, 0.4 * last, 1.5 * last, 20.0 * last};
  }
  [[nodiscard]] std::string shape_name() const override { return "decay (s)"; }

  void lidar(const BeamPoint& beam, const MeasurementTable& /*table*/, double shape,
             std::span<Eigen::Vector3d> by) const override {
    by[0] = -shape * std::expm1(-beam.time_s / shape) * beam.direction;
  }
};

}  // namespace

EffectPtr make_range_drift() {
  return std::make_shared<RangeDrift>();
}

}  // namespace lvcalib
