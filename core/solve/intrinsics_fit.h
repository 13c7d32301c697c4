// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "base/message.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "detection/board_view.h"
#include "solve/forward_problem.h"

namespace lvcalib {

/// One number per intrinsic: fx, fy, cx, cy (px), then the eight distortion entries (1).
using IntrinsicsVector = Eigen::Matrix<double, kIntrinsics, 1>;

/// What intrinsics of an ordinary calibration are known to, one standard deviation: a thousandth of
/// the focal length and of the image's width, distortion to what moves the edge of the image by
/// about half a pixel. 0 for entries that the model does not use.
IntrinsicsVector typical_intrinsics_sigma(const Camera& camera);

/// So wide that the data decide wherever they can: 30 % of the focal length, a tenth of the image.
/// What the data leave open stays where it is.
IntrinsicsVector wide_intrinsics_sigma(const Camera& camera);

/// The intrinsics as a vector, and a camera with others.
IntrinsicsVector intrinsics_of(const Camera& camera);
Camera with_intrinsics(Camera camera, const IntrinsicsVector& values);

/// The corners of one image and about where its board is.
struct CornerView {
  const std::vector<CornerObservation>* corners = nullptr;
  Rigid3 camera_from_board;
};

/// Intrinsics and board poses that fit the corners of all images.
struct IntrinsicsFit {
  Camera camera;
  std::vector<Rigid3> camera_from_board;
  /// Of the intrinsics, prior included, with the noise that the residuals show.
  Eigen::Matrix<double, kIntrinsics, kIntrinsics> covariance;
  double sigma_px = 0.0;  ///< Of one coordinate, from the residuals.
  double replicate_px =
      0.0;               ///< The same from replicates (see replicate_noise); 0 if there are few.
  double freedom = 0.0;  ///< Coordinates less poses and intrinsics.
};

/// Bundle adjustment of one camera over views of a board: minimises Σ|z − π(T P)|²/σ² with
/// Huber's loss at four σ, σ estimated from the residuals, and the intrinsics drawn to `camera`
/// with the standard deviations `prior` (0 holds an entry). Levenberg–Marquardt, poses eliminated.
/// Nothing if fewer than eight corners are seen or the problem cannot be solved.
std::optional<IntrinsicsFit> fit_intrinsics(const std::vector<CornerView>& views,
                                            const Camera& camera, const IntrinsicsVector& prior);

/// What views say about the intrinsics beyond any prior, for a joint solve that does not see these
/// views: linearized about `camera`, with the poses that fit best under it, corners of standard
/// deviation `sigma_px`. It holds near that camera; a board that faces the camera leaves a curve of
/// focal lengths open, along which a parabola holds over some per cent only: so `camera` should be
/// one that all views fit already. Nothing without views, or if a corner has no image.
std::optional<IntrinsicsEvidence> intrinsics_evidence(const std::vector<CornerView>& views,
                                                      const Camera& camera, double sigma_px);

/// Standard deviation of one corner coordinate from replicates: over each smallest rectangle of
/// corners of a board the residuals' mixed second difference (r00 − r10 − r01 + r11)/2 has the
/// variance of one of them and is blind to all that is linear across the rectangle, which is what
/// any smooth misfit looks like there: wrong intrinsics, a bent board, a pose that is off. Robust
/// against single bad corners. 0 where there are fewer than ten rectangles.
double replicate_noise(const std::vector<CornerView>& views, const Camera& camera);

/// Parts of the intrinsics that go wrong together.
enum class IntrinsicsPart { kFocalLength, kPrincipalPoint, kDistortion };

/// How estimated intrinsics differ from given ones, and what it does to the extrinsic.
struct IntrinsicsContrast {
  double chi_square = 0.0;  ///< Against "the given ones are right".
  int dof = 0;              ///< Directions of the intrinsics that the data determine.
  double gate = 0.0;        ///< What chance exceeds with the given probability.
  [[nodiscard]] bool contradicts() const { return dof > 0 && chi_square > gate; }
  /// The fewest parts that mend it when freed, the rest held as given; of as many, those with the
  /// least χ² and two for each number that is free (Akaike).
  std::vector<IntrinsicsPart> parts;
  /// Other parts, as many, that mend it, too: the data do not tell which. Likeliest first.
  std::vector<IntrinsicsContrast> alternatives;
  IntrinsicsVector difference =
      IntrinsicsVector::Zero();  ///< Estimated − given, with `parts` free.
  IntrinsicsVector sigma = IntrinsicsVector::Zero();
  /// Left perturbation by which the extrinsic differs with `parts` free from that with all free,
  /// and its covariance with `parts` free. Zero where no extrinsic is in the data.
  Vector6d correction = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Zero();
};

/// Compares `estimated` (with the data's `prior`) with `given`. `covariance` is 12 × 12 of the
/// intrinsics, or of all globals of a joint solve. In coordinates scaled by the prior, an estimate
/// of posterior variance c scatters by c(1 − c) if the given value is right. `noise_freedom`: of
/// the corners' noise in it; a few corners can look a tenth as noisy as they are (see f_gate()).
IntrinsicsContrast contrast_intrinsics(const IntrinsicsVector& estimated,
                                       const IntrinsicsVector& given,
                                       const Eigen::MatrixXd& covariance,
                                       const IntrinsicsVector& prior, double noise_freedom,
                                       double false_alarm);

/// "the focal length is 10.02 ± 0.04 % too long", "the principal point is off by 5.1 px", …; the
/// distortion's size is how far it moves the corners of `views` at most. Alternatives follow with
/// "or".
Message describe(const IntrinsicsContrast& contrast, const Camera& given,
                 const std::vector<CornerView>& views);

}  // namespace lvcalib
