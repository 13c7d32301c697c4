// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPalette>
#include <QString>

#include "pipeline/calibration.h"
#include "pipeline/camera_calibration.h"
#include "pipeline/camera_figures.h"

namespace lvcalib::widgets {

/// What is known of a camera; what is null is not there yet.
struct CameraKnowledge {
  const Camera* given = nullptr;              ///< As camera.yaml has it,
  const CameraDeviations* stated = nullptr;   ///< with the standard deviations that it states.
  const CalibrationResult* result = nullptr;  ///< That uses it or estimates it.
  const CameraCalibration* alone = nullptr;   ///< From images alone.
};

/// The intrinsics side by side: given, estimated with the extrinsic, and from images alone, each
/// with its standard deviation.
QString intrinsics_table(const CameraKnowledge& known);

/// What a calibration, with its figures, says about its camera, and what speaks against it.
QString camera_verdict(const CalibrationResult& result, const CameraFigures& figures,
                       const QPalette& palette);
/// The same of a camera calibrated from images alone.
QString camera_verdict(const CameraCalibration& calibration, const CameraFigures& figures,
                       const QPalette& palette);

}  // namespace lvcalib::widgets
