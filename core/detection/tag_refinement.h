// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "camera/camera.h"
#include "detection/tag_detector.h"
#include "target/target.h"

namespace lvcalib {

struct TagRefinementOptions {
  int max_iterations = 15;
  double stop_px = 0.002;      ///< Done when no corner moves by more.
  double surround_bits = 0.8;  ///< Width of the white surround that is used, in bits of the tag.
  int max_pixels = 3000;       ///< More pixels are thinned out; the noise then averages less.
  double min_inliers = 0.5;    ///< Smallest share of pixels that must agree with the tag.
  /// Smallest correlation of image and rendered tag over the data bits. Another tag of a family
  /// whose codes differ in 11 of 36 bits reaches 0.4.
  double min_correlation = 0.55;
};

/// A tag's corners after refinement.
struct TagRefinement {
  TagCorners corners;
  /// Covariance of each corner from the noise of the pixels alone.
  std::array<Eigen::Matrix2d, 4> covariance_px2;
  double blur_px = 0.0;      ///< Standard deviation of the image's blur, pixel area included.
  double contrast = 0.0;     ///< White minus black, grey levels.
  double noise = 0.0;        ///< Standard deviation of the residuals, grey levels.
  double correlation = 0.0;  ///< Of image and rendered tag over the data bits, all pixels.
  double inliers = 0.0;      ///< Share of pixels that agree.
};

/// Aligns the whole printed tag with the image: the known bits, the black border and a strip of the
/// white surround are rendered through a homography and a Gaussian blur, and fitted to the grey
/// values of all pixels (Gauss–Newton, Tukey weights). Unknowns: the homography (8), the blur,
/// black and white level, each linear over the tag, one coefficient of the camera's curved response
/// and how far ink has spread, which otherwise move all edges towards the dark or bright side. With
/// a camera the homography lives in undistorted coordinates, so that curved edges do not bias the
/// corners. Needs a start within about half a bit. Nothing if the fit fails, leaves the start by
/// more than a bit, or does not resemble the tag.
std::optional<TagRefinement> refine_tag(const GrayImage& image, const TagPattern& pattern,
                                        int border_bits, const TagCorners& start,
                                        const Camera* camera, const TagRefinementOptions& options);

}  // namespace lvcalib
