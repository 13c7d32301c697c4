// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "base/error.h"
#include "base/progress.h"

namespace lvcalib {

/// Whether the files that a result was made of are still those whose SHA-256 it names. `where`
/// names the result in errors; `only`: paths within the dataset, all if empty. Files that are gone,
/// and older results without hashes, pass: whoever reads them misses them. Errors: kInput for a
/// file whose content changed; kCancelled.
Status check_result_inputs(const nlohmann::json& result, const std::string& where,
                           const std::vector<std::string>& only, const RunContext& context);

}  // namespace lvcalib
