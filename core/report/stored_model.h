// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "base/error.h"
#include "model/linear_model.h"
#include "model/model_scales.h"
#include "pipeline/calibration.h"

namespace lvcalib {

/// The effects of a finished calibration, as its result file holds them.
struct StoredModel {
  std::vector<EffectInUse> effects;  ///< Empty if nothing was found.
  ModelScales scales;
};

/// Reads `model` from result.json.
/// Errors (kInput, naming file and key): no such file, not JSON, no model, an effect that this
/// version does not know, parameters missing, not finite or in another unit.
Result<StoredModel> read_model(const std::filesystem::path& path);

/// The same of a calibration that was not written.
Result<StoredModel> model_of(const CalibrationResult& result);

}  // namespace lvcalib
