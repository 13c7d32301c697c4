// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "pipeline/calibration.h"

namespace lvcalib {

/// Size of the board as the LiDAR measures it over the model's, from all used scenes together.
/// Sigma 0 if there is nothing to measure it by. Scenes whose size
/// differs from the median of all by more than `outlier` and by five standard deviations are left
/// out.
struct MeasuredScale {
  double scale = 1.0;
  double sigma = 0.0;
};
MeasuredScale measured_scale(const CalibrationResult& result,
                             double outlier = QualityOptions{}.scale_warning);

/// How much larger a scene's board measures than the median of all; sigma 0 below three scenes, of
/// which none could be told from the others.
MeasuredScale relative_scale(const CalibrationResult& result, const SceneResult& scene);

/// Sets quality and adds the warnings that explain it.
void judge_quality(CalibrationResult& result, const QualityOptions& options);

}  // namespace lvcalib
