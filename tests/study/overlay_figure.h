// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "base/error.h"
#include "pipeline/calibration.h"

namespace lvcalib::study {

/// One scene's camera image with the LiDAR points of the board seen through the estimated
/// extrinsic, the circles where the camera predicts them and the centres that the LiDAR refined;
/// one node enlarged.
Status draw_overlay(const Dataset& dataset, const CalibrationResult& result,
                    const std::filesystem::path& path);

}  // namespace lvcalib::study
