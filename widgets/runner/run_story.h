// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "pipeline/session.h"

namespace lvcalib::widgets {

/// What a run that gave a result has done and why, for the log: "Ran (options changed): refinement
/// 0.19 s, joint solve 0.49 s. Kept: images, search in the clouds." `before` is the state that the
/// run started from.
QString run_story(const SessionState& before, const SessionRun& run);

}  // namespace lvcalib::widgets
