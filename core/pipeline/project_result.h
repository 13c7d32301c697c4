// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "pipeline/calibration.h"
#include "pipeline/project_file.h"
#include "selection/model_session.h"

namespace lvcalib {

/// The calibration at the last of a model's steps; `base` itself where that step has no effects.
/// `steps` begin at `base` and are all made.
std::shared_ptr<const CalibrationResult> result_at(
    const std::shared_ptr<const CalibrationResult>& base, const std::vector<ModelStepPtr>& steps);

/// What a project's decisions give: its dataset calibrated from nothing, with the effects that its
/// model has. Errors: kInput if the dataset is not where the project says; those of open_dataset(),
/// run_session() and apply_decision().
Result<std::shared_ptr<const CalibrationResult>> calibrate_project(const Project& project,
                                                                   const RunContext& context);

}  // namespace lvcalib
