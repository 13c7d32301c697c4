// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/random.h"
#include "base/rigid3.h"
#include "simulation/printed_board.h"
#include "simulation/room.h"
#include "simulation/simulation_options.h"

namespace lvcalib::simulation {

/// A closed room around sensors and board: floor, ceiling, walls (the one behind the board
/// 0.4 to 3 m away, or touching it), the board on its stand, a decoy panel, boxes. Nothing hides
/// the board from either sensor. `board` must outlive the room.
Room build_room(const SimulationOptions& options, const PrintedBoard& board,
                const Rigid3& lidar_from_board, const Eigen::Vector3d& camera_in_lidar_m,
                Random random);

}  // namespace lvcalib::simulation
