// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPalette>
#include <QString>
#include <optional>

#include "pipeline/calibration.h"

namespace lvcalib::widgets {

/// The result's report on its uncertainty, projected once more with the total covariance: what
/// noise alone leaves is many times smaller than what is stated beside it. Nothing if the result
/// states no total.
std::optional<UncertaintyReport> total_report(const CalibrationResult& result);

/// How far the extrinsic can be trusted, as HTML: directions that are known worst, halves of the
/// scenes against each other, the result without each scene, its uncertainty over image and range,
/// from noise alone and in total.
/// What there are not enough scenes for says so.
QString uncertainty_html(const CalibrationResult& result, const QPalette& palette);

}  // namespace lvcalib::widgets
