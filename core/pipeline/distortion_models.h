// SPDX-License-Identifier: BSD-3-Clause
// Which distortion model a lens has, by what each predicts of images that it was not fitted to.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "camera/camera.h"
#include "detection/board_view.h"
#include "solve/intrinsics_fit.h"

namespace lvcalib {

/// What every tool reads first, what fits almost anything last.
inline constexpr std::array kDistortionModels = {DistortionModel::kPlumbBob,
                                                 DistortionModel::kEquidistant,
                                                 DistortionModel::kRationalPolynomial};

/// Views with the poses that fit best under a camera; those that no pose fits keep theirs.
/// `misfit_px` is the RMS of a coordinate, for which corners that fit no pose at all count as if
/// they missed by a tenth of the image.
std::vector<CornerView> posed_views(std::vector<CornerView> views, const Camera& camera,
                                    const DetectionOptions& detection, double& misfit_px);

/// How far corners may miss a pose while the camera is a guess: distortion of tens of pixels does
/// not cost the board.
DetectionOptions tolerant(DetectionOptions options, int width_px);

/// Camera and poses that fit all corners, in the start's distortion model, drawn nowhere: the prior
/// is wide and laid about the estimate. Nothing where they cannot be fitted.
std::optional<IntrinsicsFit> fit_from(const std::vector<CornerView>& views, const Camera& start,
                                      const DetectionOptions& detection);

/// Mean square of a coordinate (px²) in each view while it was held out: the others' camera, fitted
/// from `start`, and the pose that fits best under it. Views come in so many parts, each predicted
/// by the others. Empty if some part cannot be predicted, or `context` is stopped.
std::vector<double> held_out_squares(const std::vector<CornerView>& views, const Camera& start,
                                     const DetectionOptions& detection, int folds,
                                     const RunContext& context);

/// RMS of a coordinate over such squares.
double rms_of(const std::vector<double>& squares);

/// Corners of the image that the camera has no ray for: the distortion folds back before them.
int blind_corners(const Camera& camera);

/// Whether squares `b` of held-out images are lower than `a` beyond chance: the logarithm of their
/// ratio by more than two of its standard deviations over images (so that one image in which both
/// are far off does not drown what all others say), and their mean by two per cent at least.
bool predicts_better(const std::vector<double>& a, const std::vector<double>& b);

/// A distortion model that predicts held-out images better than the given one.
struct BetterDistortion {
  IntrinsicsFit fit;         ///< In that model, to all views.
  double given_px = 0.0;     ///< RMS of a coordinate in held-out images: of the given model,
  double held_out_px = 0.0;  ///< and of this one.
};

/// Asks the other distortion models, as `given` is the fit in the one that camera.yaml has. One
/// counts if it fits all images better than a fit with so many more numbers would by chance (with
/// the probability `false_alarm`), folds back in no more corners of the image, and
/// predicts_better(); of several, the one that predicts best. The first of these costs one fit a
/// model and spares most runs the last. Corners' errors are not independent, which is why the last
/// is asked. Nothing below five views.
std::optional<BetterDistortion> better_distortion(const std::vector<CornerView>& views,
                                                  const IntrinsicsFit& given,
                                                  const DetectionOptions& detection,
                                                  double false_alarm, const RunContext& context);

}  // namespace lvcalib
