// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "pipeline/calibration.h"
#include "simulation/simulator.h"

namespace lvcalib::study {

/// A share of a count with its 95 % interval (Wilson), as text: "29 of 30 (83–99 %)".
std::string share_text(int hits, int count);

/// Mean with the half-width of its 95 % interval, as text: "1.23 ± 0.04".
std::string mean_text(const std::vector<double>& values);

/// Writes the rig as a dataset, calibrates it on one thread and removes it again.
Result<CalibrationResult> calibrate_rig(const simulation::SimulatedRig& rig,
                                        const std::filesystem::path& folder);

/// Each prints a markdown table.
/// `condition`: jitter, footprint, camera or dense; all of them if empty.
void study_methods(int rigs, std::uint64_t first_seed, const std::filesystem::path& folder,
                   const std::string& condition);
void study_bad_scenes(int rigs, std::uint64_t first_seed, const std::filesystem::path& folder);
void study_downstream(int seeds, std::uint64_t first_seed);

}  // namespace lvcalib::study
