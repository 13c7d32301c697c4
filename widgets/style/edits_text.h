// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <string>
#include <vector>

#include "pipeline/calibration.h"

namespace lvcalib::widgets {

/// "3, 7, 12"
QString ids_text(const std::vector<int>& ids);

/// "312 points, tags 3 and 7": what the user left out of a scene by hand, or uses all the same;
/// empty if nothing.
QString edits_text(const SceneResult& scene);

/// What the user has used all the same of a scene, in a sentence; empty if nothing.
QString kept_text(const SceneEdits& edits);

/// What the program refused of a scene that takes part, in a sentence; empty if nothing.
QString refusals_text(const CalibrationResult& result, const std::string& scene);

}  // namespace lvcalib::widgets
