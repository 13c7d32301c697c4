// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "base/error.h"
#include "base/progress.h"
#include "simulation/simulation_options.h"

namespace lvcalib::widgets {

/// What the demo simulates: four scenes of the standard board, and a LiDAR whose dark returns read
/// far, for its user to find.
simulation::SimulationOptions demo_options();

/// Simulates a dataset into `folder`, in the place of an earlier demo. Reports stage "simulate".
/// kCancelled leaves nothing behind.
Status make_demo(const std::filesystem::path& folder, const simulation::SimulationOptions& options,
                 const RunContext& context);

}  // namespace lvcalib::widgets
