// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <vector>

#include "pipeline/calibration.h"

namespace lvcalib::widgets {

/// "3, 7, 12"
QString ids_text(const std::vector<int>& ids);

/// "312 points, tags 3 and 7": what the user left out of a scene by hand, or uses all the same;
/// empty if nothing.
QString edits_text(const SceneResult& scene);

}  // namespace lvcalib::widgets
