// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPalette>
#include <QString>

#include "pipeline/calibration.h"
#include "words/quality_text.h"

namespace lvcalib::widgets {

/// Quality, pose with standard deviations in all usual forms, weak directions and warnings as rich
/// text for a result page.
QString pose_html(const CalibrationResult& result, const Standing& standing,
                  const QPalette& palette);

}  // namespace lvcalib::widgets
