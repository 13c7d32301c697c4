// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnostics/residual_columns.h"
#include "pipeline/calibration.h"
#include "pipeline/camera_calibration.h"
#include "solve/uncertainty_report.h"

namespace lvcalib {

/// What the corners of all images say about a camera, over its image.
struct CameraFigures {
  struct Image {
    std::string name;            ///< Of the scene; of other images folder and file.
    std::filesystem::path path;  ///< Empty: the scene's image.
    std::size_t corners = 0;     ///< In use.
    double rms_px = 0.0;         ///< RMS distance between them and where the camera puts them.
    Message reason;              ///< Why none is in use; empty if there are some.
  };
  std::vector<Image> images;
  /// Two rows for each corner (u, v): measured − predicted, px, with the covariates "image x" and
  /// "image y". `scene` is the index into images, `row` is empty.
  ResidualColumns corners;
  /// See project_intrinsics(). Without pixels where nothing is known of the intrinsics but
  /// themselves: they are held, and camera.yaml states no standard deviations.
  ProjectedUncertainty projection;
  std::vector<Message> unreached;  ///< Parts of the image without a corner.
};

/// Of a camera calibrated from images alone.
CameraFigures camera_figures(const CameraCalibration& calibration);

/// Of the camera that a calibration used: corners of the scenes in use under the model in force and
/// of the images of intrinsics/ that count; uncertainty by the joint solve where the intrinsics
/// were estimated, else as camera.yaml states it.
CameraFigures camera_figures(const CalibrationResult& result);

/// Ninths of the image ("top left", …, row by row) that hold none of these pixels.
std::vector<Message> unreached_parts(const std::vector<Eigen::Vector2d>& pixels,
                                     const Camera& camera);
/// What that means for the distortion; empty where there are none.
Message describe_unreached(const std::vector<Message>& parts);

}  // namespace lvcalib
