// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "base/error.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "detection/board_view.h"

namespace lvcalib {

/// Pose of a planar board from corners in one image.
struct BoardPose {
  /// Covariance of the left perturbation: σ² (JᵀJ)⁻¹ over the corners that agree.
  UncertainRigid3 camera_from_board;
  std::optional<Rigid3> alternative_pose;  ///< See BoardView.
  double sigma_px = 0.0;                   ///< Of one coordinate, from 2n − 6 degrees of freedom.
  double rms_px = 0.0;                     ///< Of the coordinates' residuals of agreeing corners.
  std::vector<double> residual_px;         ///< Distance of each corner from its reprojection.
  std::vector<bool> agrees;                ///< Not an outlier in the fit.
};

/// Both poses of the planar ambiguity (Collins and Bartoli's IPPE on undistorted coordinates) are
/// refined on the reprojection error, robustly (Tukey); the one that fits better is kept. Corners
/// weigh by their sigma_px where they state one. Starts come from samples of four corners, at most
/// `samples` of them (RANSAC): 2000 find the pose where a quarter of the corners agrees, 60 where
/// two thirds do. Errors (kInput): fewer than four corners, or corners that fit no pose.
Result<BoardPose> estimate_board_pose(const std::vector<CornerObservation>& corners,
                                      const Camera& camera, const DetectionOptions& options,
                                      int samples = 2000);

}  // namespace lvcalib
