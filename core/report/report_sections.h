// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/message.h"
#include "report/stored_model.h"

namespace lvcalib {

// Sections of the HTML report, each from the result file alone (the scene's also from its image).
// They throw nlohmann::json::exception on a result that lacks what they show; internal to this
// room.

/// The first page: what was calibrated, how well, whether it can be used and for which clouds, and
/// what to do next. `day` is when the result was made; `use` is none for a result without a model.
std::string verdict_section(const nlohmann::json& result, const std::optional<PoseUse>& use,
                            const std::string& day);
std::string pose_section(const nlohmann::json& result);
std::string uncertainty_section(const nlohmann::json& result);
std::string methods_section(const nlohmann::json& result);
std::string scene_section(const nlohmann::json& result, const nlohmann::json& scene,
                          std::vector<Message>& warnings);
std::string response_section(const nlohmann::json& result);
/// Effects in use and, if `discovery` (a discovery file) is not null, error before and after,
/// verdicts and what the scenes cannot show.
std::string model_section(const nlohmann::json& result, const nlohmann::json& discovery);
std::string provenance_section(const nlohmann::json& result);

/// A table: the first row is the head. Cells are taken as HTML.
std::string html_table(const std::vector<std::vector<std::string>>& rows);

}  // namespace lvcalib
