// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/message.h"
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

/// The same of a result.json's text; `where` names it in errors.
Result<StoredModel> model_in(const std::string& result_json, const std::string& where);

/// What a pose is for, in words. One wording for window, report, exports and command line.
struct PoseUse {
  Message model;                 ///< "Base model", "Base model + Range walk".
  std::vector<Message> effects;  ///< "Range walk: a = 16.3 mm", one for each.
  /// True for clouds with effects taken out; false for clouds as the LiDAR gives them, with a base
  /// model or one whose effects are not in the points.
  bool corrected = false;
  Message clouds;  ///< The same as a sentence.
};
PoseUse pose_use(const StoredModel& model);
PoseUse pose_use(const CalibrationResult& result);

/// What a total standard deviation holds beside the statistical one, as a sentence.
Message total_uncertainty_note();

}  // namespace lvcalib
