// SPDX-License-Identifier: BSD-3-Clause
#include "model/device_faults.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace lvcalib {

DeviceFaults::DeviceFaults() {
  for (const EffectPtr& effect : effect_catalogue()) {
    Stated stated{effect, {}};
    for (const EffectParameter& parameter : effect->parameters(table_))
      stated.faults.push_back(parameter.device_fault);
    if (std::any_of(stated.faults.begin(), stated.faults.end(),
                    [](const auto& fault) { return fault.has_value(); }))
      stated_.push_back(std::move(stated));
  }
}

FaultMoves DeviceFaults::moves(const Eigen::Vector3d& point_m) const {
  BeamPoint beam;
  beam.range_m = point_m.norm();
  beam.direction = point_m / beam.range_m;
  beam.azimuth_rad = std::atan2(point_m.y(), point_m.x());
  beam.elevation_rad = std::asin(beam.direction.z());
  FaultMoves out = FaultMoves::Zero();
  std::vector<Eigen::Vector3d> by;
  for (const Stated& stated : stated_) {
    by.assign(stated.faults.size(), Eigen::Vector3d::Zero());
    stated.effect->lidar(beam, table_, 0.0, by);
    for (std::size_t k = 0; k < by.size(); ++k) {
      if (stated.faults[k]) out.col(static_cast<Eigen::Index>(*stated.faults[k])) = by[k];
    }
  }
  return out;
}

}  // namespace lvcalib
