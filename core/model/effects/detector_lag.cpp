// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class DetectorLag final : public CatalogueEffect {
 public:
  DetectorLag()
      : CatalogueEffect(
            {.id = "detector_lag",
             .group = "beam",
             .title = "Lag of the intensity",
             .physics = "The detector needs time to recover, so that edges move along the scan.",
             .formula = "dd = v τ cos(scan direction - ψ), in the board: over cos θ up the slope",
             .source = "derived",
             .discriminating_pose = "scans that cross edges in both directions",
             .needs = {.time = true, .circles = true, .intensity = true}},
            {{.name = "τ",
              .unit = "µs",
              .unit_in_si = 1e-6,
              .size_of_interest = 2e-6,
              .prior_sigma = 1e-3,
              .lowest = 0.0}}) {}

  void edge(const BoundaryRow& row, const MeasurementTable& table, double /*shape*/,
            std::span<double> by) const override {
    if (table.print) return;  // See spot().
    by[0] = row.beam.scan_rad_s.dot(row.edge_normal_rad);
  }
  void spot(const BeamPoint& beam, const MeasurementTable& /*table*/, double /*shape*/,
            std::span<Eigen::Vector3d> by) const override {
    const AngleAxes axes = angle_axes(beam);
    by[0] = beam.scan_rad_s.x() * axes.azimuth_m + beam.scan_rad_s.y() * axes.elevation_m;
  }
};

}  // namespace

EffectPtr make_detector_lag() {
  return std::make_shared<DetectorLag>();
}

}  // namespace lvcalib
