// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "model/effect.h"

namespace lvcalib {

/// Displacements (LiDAR frame, m) of a point by one unit of each device fault (m, rad, 1).
using FaultMoves = Eigen::Matrix<double, 3, kDeviceFaults>;

/// What the faults that every device has do to a point, as the effects of the catalogue that state
/// them write it.
class DeviceFaults {
 public:
  DeviceFaults();
  [[nodiscard]] FaultMoves moves(const Eigen::Vector3d& point_m) const;

 private:
  struct Stated {
    EffectPtr effect;
    std::vector<std::optional<DeviceFault>> faults;  // By parameter.
  };
  std::vector<Stated> stated_;
  MeasurementTable table_;  // Such faults depend on the beam alone.
};

}  // namespace lvcalib
