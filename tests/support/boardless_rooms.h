// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulation/simulation_options.h"

namespace lvcalib::test {

/// Two small rooms without a board, with boxes and a panel whose edges both sensors see.
inline simulation::SimulationOptions boardless_rooms() {
  simulation::SimulationOptions options;
  options.seed = 31;
  options.scenes = 2;
  options.image.width_px = 960;
  options.image.height_px = 600;
  options.placement.board = false;
  options.lidar.kind = simulation::LidarKind::kRosette;
  return options;
}

}  // namespace lvcalib::test
