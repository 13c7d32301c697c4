// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPalette>
#include <QString>

#include "pipeline/calibration.h"

namespace lvcalib::widgets {

/// How far the extrinsic can be trusted, as HTML: directions that are known worst, halves of the
/// scenes against each other, the result without each scene, its uncertainty over image and range.
/// What there are not enough scenes for says so.
QString uncertainty_html(const CalibrationResult& result, const QPalette& palette);

}  // namespace lvcalib::widgets
