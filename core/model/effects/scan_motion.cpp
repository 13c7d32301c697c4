// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class ScanMotion final : public CatalogueEffect {
 public:
  ScanMotion()
      : CatalogueEffect({.id = "scan_motion",
                         .group = "time",
                         .title = "Motion during the scan",
                         .physics = "The LiDAR or the board moved while the scan was taken.",
                         .formula = "p += v t",
                         .source = "derived",
                         .discriminating_pose = "let the rig rest; take a shorter scan",
                         .needs = {.time = true}},
                        alike({.name = "vx",
                               .unit = "mm/s",
                               .unit_in_si = 1e-3,
                               .size_of_interest = 5e-3,
                               .prior_sigma = 1.0},
                              {"vy", "vz"})) {}

  void lidar(const BeamPoint& beam, const MeasurementTable& /*table*/, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    for (int k = 0; k < 3; ++k)
      by[static_cast<std::size_t>(k)] = beam.time_s * Eigen::Vector3d::Unit(k);
  }
};

}  // namespace

EffectPtr make_scan_motion() {
  return std::make_shared<ScanMotion>();
}

}  // namespace lvcalib
