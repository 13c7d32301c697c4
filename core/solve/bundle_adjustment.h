// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "base/rigid3.h"
#include "camera/camera.h"
#include "detection/board_view.h"
#include "solve/forward_problem.h"
#include "solve/intrinsics_fit.h"

namespace lvcalib {

/// Points of one rigid body and where one image shows them.
struct SeenPoints {
  std::vector<Eigen::Vector3d> point_m;  ///< In the body's frame.
  std::vector<Eigen::Vector2d> pixel;
};

/// Adds a board's corners to those of a body in whose frame the board is at `body_from_board`.
void add_corners(const std::vector<CornerObservation>& corners, const Rigid3& body_from_board,
                 SeenPoints& to);

/// Camera and poses that fit all points.
struct BundleFit {
  Camera camera;
  std::vector<Rigid3> poses;  ///< Camera from body, one for each view.
  /// Of the intrinsics, prior included, with the noise that the residuals show.
  Eigen::Matrix<double, kIntrinsics, kIntrinsics> covariance;
  double sigma_px = 0.0;  ///< Of one coordinate, from the residuals.
  double freedom = 0.0;   ///< Coordinates less poses and intrinsics.
};

/// Bundle adjustment of one camera over views of known bodies: minimises Σ|z − π(T P)|²/σ² with
/// Huber's loss at four σ, σ estimated from the residuals, and the intrinsics drawn to `camera`
/// with the standard deviations `prior` (0 holds an entry). Levenberg–Marquardt from `poses`, which
/// are eliminated. Of one body it is the resection of the camera. Nothing if fewer than eight
/// points are seen or the problem cannot be solved.
std::optional<BundleFit> fit_bundle(const std::vector<SeenPoints>& views,
                                    const std::vector<Rigid3>& poses, const Camera& camera,
                                    const IntrinsicsVector& prior);

/// What views say about the intrinsics beyond any prior, linearized about `camera` with the poses
/// that fit best under it; see intrinsics_evidence(). Nothing if a point has no image.
std::optional<IntrinsicsEvidence> bundle_evidence(const std::vector<SeenPoints>& views,
                                                  const std::vector<Rigid3>& poses,
                                                  const Camera& camera, double sigma_px);

}  // namespace lvcalib
