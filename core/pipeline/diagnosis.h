// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/calibration.h"

namespace lvcalib {

/// After the board was not found in any cloud: whether it is found once the cloud is taken for one
/// in millimetres, centimetres, feet or inches, or for a mirrored one. The error that says so.
std::optional<Error> diagnose_clouds(const Dataset& dataset, const CalibrationRequest& request,
                                     const CalibrationResult& result, const RunContext& context);

/// The two scenes after whose images have been exchanged all scenes agree, if they did not before.
std::optional<std::pair<std::size_t, std::size_t>> exchanged_images(
    std::vector<SceneHypotheses> scenes, int agreeing, const ConsensusOptions& options);

/// After scenes have found boards that do not agree: whether two or more agree once the clouds are
/// taken for mirrored ones. The error that says so.
std::optional<Error> diagnose_mirrored(const Dataset& dataset, const CalibrationRequest& request,
                                       const CalibrationResult& result,
                                       std::vector<SceneHypotheses> scenes,
                                       const RunContext& context);

/// How a rough extrinsic went wrong, seen from the one that the scenes give: "it is the inverse",
/// "its translation is in millimetres", …
std::string diagnose_guess(const Rigid3& guess, const Rigid3& camera_from_lidar);

/// Scenes whose image and cloud have the same content as those of an earlier scene: place of the
/// first of them, or nothing, per scene.
std::vector<std::optional<std::size_t>> same_files(const Dataset& dataset, bool use_crops,
                                                   const RunContext& context);

}  // namespace lvcalib
