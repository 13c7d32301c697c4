// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "base/error.h"
#include "design/planning.h"

namespace lvcalib {

/// The text of plan.json: for every scene T_camera_board, T_lidar_board, a sentence, the
/// extrinsic's standard deviations once it is taken (null while it is not determined), and how far
/// what matters of the wanted effects stands above zero; what was known before, if anything was.
std::string plan_as_json(const ScenePlan& plan);

Status write_plan(const ScenePlan& plan, const std::filesystem::path& path);

}  // namespace lvcalib
