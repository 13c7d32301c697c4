// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "solve/feature_solver.h"

namespace lvcalib {

/// Standard deviations that the joint objective uses, estimated from round to round.
struct NoiseScales {
  double sigma_px = 0.1;
  double node = 1.0;
  double plane = 1.0;
};

/// Groups of residuals with a common noise scale.
enum class ResidualGroup { kCorner = 0, kNode = 1, kPlane = 2 };
constexpr std::size_t kResidualGroups = 3;

/// Which observations take part.
struct ObservationMask {
  std::vector<bool> scene;
  std::vector<std::vector<bool>> corner;  ///< per scene
  std::vector<std::vector<bool>> node;
};

/// The observations and scales that a finished solve has settled on.
ObservationMask mask_of(const ExtrinsicSolution& solution);
NoiseScales scales_of(const ExtrinsicSolution& solution);

/// State of the joint solve: extrinsic and board poses.
struct JointState {
  Rigid3 camera_from_lidar;
  std::vector<Rigid3> camera_from_board;
};

/// Sums of one group: Σ whitened residual² and its redundancy n − trace of the hat matrix.
struct GroupFit {
  double chi_square = 0.0;
  double redundancy = 0.0;
  int count = 0;
};

/// What a solve leaves behind.
struct JointFit {
  JointState state;
  Matrix6d information = Matrix6d::Zero();  ///< Of the extrinsic, board poses eliminated.
  std::array<GroupFit, kResidualGroups> groups;
  bool converged = false;
};

/// Solves the weighted objective once, with fixed scales and mask.
JointFit solve_joint(const FeatureInput& in, const JointState& start, const NoiseScales& scales,
                     const ObservationMask& mask);

/// Board poses that fit best when the extrinsic is held at `camera_from_lidar`: what an extrinsic
/// leaves of the objective, wherever it comes from. Scenes not in the mask keep their start.
std::vector<Rigid3> solve_boards(const FeatureInput& in, const JointState& start,
                                 const NoiseScales& scales, const ObservationMask& mask);

/// Inverse square root (upper Cholesky factor of the inverse) of a covariance: whitening·residual
/// has unit covariance.
Eigen::Matrix2d whitening_2(const Eigen::Matrix2d& covariance);
Eigen::Matrix3d whitening_3(const Eigen::Matrix3d& covariance);

/// The three board points whose heights over the plane stand for the plane (columns).
Eigen::Matrix3d plane_probe_points(const Target& target);

/// Covariance of the heights of the probe points over a fitted plane.
Eigen::Matrix3d probe_covariance(const FittedPlane& plane, const Rigid3& lidar_from_board,
                                 const Eigen::Matrix3d& probes_m, double floor_m);

}  // namespace lvcalib
