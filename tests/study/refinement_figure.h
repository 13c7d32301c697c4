// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "base/error.h"
#include "pipeline/calibration.h"

namespace lvcalib::study {

/// One node's transition midpoints over the polar angle, in the first and in the last iteration of
/// the refinement, with the fitted first-order wave. Takes the node that had farthest to go.
Status draw_refinement(const CalibrationResult& result, const std::filesystem::path& path);

}  // namespace lvcalib::study
