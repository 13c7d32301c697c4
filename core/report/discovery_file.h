// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "base/error.h"
#include "pipeline/calibration.h"
#include "report/frame_names.h"
#include "selection/discovery.h"

namespace lvcalib {

/// The text of discovery.json (keys: see resources/guide/effects.md). Parameters in their display
/// units.
std::string discovery_as_json(const Discovery& discovery);

/// A summary that a technician understands: what was found, how sure, what it does to the
/// extrinsic, what is left, what to do next.
std::string discovery_summary(const Discovery& discovery);

/// Writes discovery.json, discovery.txt, and result.json and result.yaml of the model found into a
/// folder (created if needed): all of one run, or none.
Status write_discovery(const Discovery& discovery, const CalibrationResult& result,
                       const std::filesystem::path& folder, const FrameNames& frames = {});

}  // namespace lvcalib
