// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "pipeline/calibration.h"

namespace lvcalib {

// Parts of result.json. Internal to this room: nlohmann's header is not part of the API.

nlohmann::ordered_json camera_json(const Camera& camera);
nlohmann::ordered_json inputs_json(const std::vector<InputFile>& inputs);
nlohmann::ordered_json methods_json(const std::vector<MethodResult>& methods);
nlohmann::ordered_json ablation_json(const std::vector<AblationStep>& steps);
nlohmann::ordered_json uncertainty_json(const UncertaintyReport& report);
nlohmann::ordered_json response_json(const BoundaryResponse& response);
/// Effects of the model and what their numbers refer to; see report/stored_model.h.
nlohmann::ordered_json model_json(const CalibrationResult& result);

nlohmann::ordered_json budget_json(const std::vector<BudgetItem>& budget);

/// Mid-level crossings of every node by angle, in the first and in the last iteration.
nlohmann::ordered_json profile_json(const BoardRefinement& refinement);

}  // namespace lvcalib
