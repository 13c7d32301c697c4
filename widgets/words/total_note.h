// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "pipeline/calibration.h"

namespace lvcalib::widgets {

/// What a result's total standard deviations hold beside its noise. A model's own budget follows a
/// while after its pose; until then this says that the numbers will change by themselves.
QString total_note(const CalibrationResult& result);

}  // namespace lvcalib::widgets
