// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "camera/camera.h"
#include "detection/board_view.h"
#include "pipeline/board_images.h"
#include "solve/intrinsics_fit.h"
#include "target/target.h"

namespace lvcalib {

struct CameraCalibrationOptions {
  DetectionOptions detection;
  /// Start; without it everything is found from the images. The estimate is not drawn to it.
  std::optional<Camera> start;
  /// The distortion model; without it the one that predicts held-out images best.
  std::optional<DistortionModel> model;
  /// Held-out images come in so many parts: each is predicted by the others.
  int folds = 5;
  /// Fewer images than this do not compare distortion models: plumb_bob then.
  int fewest_to_compare = 4;
  /// A focal length known to no better than this share of it is no result.
  double largest_focal_sigma = 0.05;
};

/// How well a distortion model predicts images that it was not fitted to.
struct ModelPrediction {
  DistortionModel model = DistortionModel::kPlumbBob;
  /// RMS of one corner coordinate in held-out images, each board's pose fitted to it; 0 if the
  /// model could not be fitted, or was not asked.
  double held_out_px = 0.0;
};

/// A camera calibrated from images of the board alone.
struct CameraCalibration {
  Camera camera;
  /// Of fx fy cx cy and eight distortion entries; 0 for entries that the model does not use. With
  /// the noise that the residuals show, and a prior so wide that it matters only where the images
  /// say nothing (see wide_intrinsics_sigma()).
  IntrinsicsVector sigma = IntrinsicsVector::Zero();
  Eigen::Matrix<double, kIntrinsics, kIntrinsics> covariance =
      Eigen::Matrix<double, kIntrinsics, kIntrinsics>::Zero();
  std::vector<BoardImage> images;  ///< All that were given; views under the estimated camera.
  double rms_px = 0.0;             ///< RMS distance between corners and their reprojections.
  double noise_px = 0.0;           ///< Of one coordinate: see IntrinsicsFit::sigma_px
  double replicate_px = 0.0;       ///< and replicate_noise().
  std::vector<ModelPrediction> predictions;  ///< Of the models compared; empty if none were.
  std::vector<Message> warnings;
  [[nodiscard]] std::size_t used_images() const;
};

/// Calibrates a camera from what images show of the board: start, models compared on held-out
/// images, bundle adjustment, and what there is to be said against the result. Views in use need
/// corners; their poses need not be right, nor the camera they were found with. An image whose
/// corners miss the others' camera by far is left out and says so.
///
/// Start: for each of a ladder of focal lengths the boards' poses alone are fitted, without
/// distortion; the length that leaves the least goes into the bundle adjustment (a closed form
/// from homographies would need an image without distortion). Models are asked in the order
/// plumb_bob, equidistant, rational_polynomial: what every tool reads first, the one that fits
/// almost anything last. A later one is taken if the logarithm of its mean squared error in
/// held-out images is lower by more than two standard deviations of that difference over images,
/// and the mean square of all by two per cent at least; or if it predicts no worse and the earlier
/// one folds back inside the image. One that folds back there does not replace one that does not.
///
/// Errors: kInput without any image in use; kUntrusted if the corners do not determine the focal
/// length; kCancelled.
Result<CameraCalibration> calibrate_camera(std::vector<BoardImage> images,
                                           const CameraCalibrationOptions& options,
                                           const RunContext& context);

/// The same from files: looks for the board with a guess (focal length: the image's width), fits,
/// looks again with the camera that came out, and fits again. Images that cannot be read or show
/// no board are left out with a warning. Errors as above, and kInput for images of different
/// sizes (names the first that differs) and where no image shows the board.
Result<CameraCalibration> calibrate_camera(const std::vector<std::filesystem::path>& images,
                                           const Target& target,
                                           const CameraCalibrationOptions& options,
                                           const RunContext& context);

}  // namespace lvcalib
