// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Boundary response of a LiDAR (LV-Calib, section III-D): how returns near a reflectivity edge
// scatter about it.
//
// Angles are seen from the LiDAR along the line of sight: yaw across it (horizontal, towards
// ẑ × sight), pitch upwards. Both are true angles, so that yaw does not stretch with elevation;
// where the LiDAR's z axis is nearly the line of sight its y axis stands in for "up".

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "base/error.h"
#include "base/progress.h"
#include "cloud/cloud.h"
#include "refinement/board_refinement.h"
#include "response/transition_fit.h"
#include "target/target.h"

namespace lvcalib {

struct ResponseOptions {
  /// Half-width of the overlap region in units of the transition's σ. √6: a beam whose footprint
  /// has σ per axis then leaves σ per axis in the residuals, since uniformly lying points within
  /// ±kσ have the variance k²σ²/3 across the edge, and pairing with the nearest boundary point
  /// keeps one axis of two.
  double overlap_sigmas = 2.45;
  /// Fewer overlap samples say nothing about a standard deviation: 200 give it to 5 %.
  int min_samples = 200;
  int min_node_samples = 30;        ///< The same for a single node: it is only shown, not judged.
  double min_contrast = 3.0;        ///< Level difference in units of the plateaus' noise.
  double max_clipped_share = 0.2;   ///< Share of a plateau at the end of the intensity scale.
  double range_bin_m = 1.0;         ///< Width of the classes of range.
  double incidence_bin_deg = 15.0;  ///< And of incidence.
};

/// Why a node gives no boundary samples.
enum class NodeResponseState {
  kUsed,
  kNotRefined,     ///< The refinement has no centre for it.
  kTooFewSamples,  ///< Fewer overlap samples than min_node_samples.
  kNoContrast,     ///< Black and white do not stand clear of the noise.
  kClipped,        ///< A plateau lies at the end of the intensity scale.
};
/// One line of plain words.
Message describe(NodeResponseState state);

struct NodeResponse {
  int id = 0;
  NodeResponseState state = NodeResponseState::kNotRefined;
  Message reason;   ///< Plain words with numbers; empty when used.
  int samples = 0;  ///< In the region of interest.
  int overlap = 0;  ///< Of these in the overlap region.
};

/// A LiDAR point near a circle and its nearest ideal boundary point.
struct BoundarySample {
  Eigen::Vector2f board_m = Eigen::Vector2f::Zero();   ///< Where its ray meets the board.
  Eigen::Vector2f outward = Eigen::Vector2f::UnitX();  ///< From the circle's centre, on the board.
  float distance_m = 0.0F;                             ///< Signed, outside the circle positive.
  float intensity = 0.0F;
  float range_m = 0.0F;           ///< Of the nearest boundary point.
  float cos_incidence = 1.0F;     ///< At it.
  float range_residual_m = 0.0F;  ///< Measured range − range of the board along the same ray.
  /// (Δpitch [rad], Δyaw [rad], Δrange [m]) to the nearest boundary point (paper, eq. 11).
  Eigen::Vector3f residual = Eigen::Vector3f::Zero();
  /// How far an angular error (pitch, yaw) moves the hit across the edge, m/rad.
  Eigen::Vector2f across_m = Eigen::Vector2f::Zero();
  /// How far it moves the board's range along the ray, m/rad.
  Eigen::Vector2f slant_m = Eigen::Vector2f::Zero();
  float width_m = 0.0F;  ///< The transition's σ in this direction.
  int node = 0;          ///< Index into the scene's nodes.
  bool overlap = false;
};

/// Statistics of overlap samples. Order of matrices: pitch, yaw (rad), range (m).
///
/// `covariance` describes a return whose beam was on the edge. Its angular part A is the one whose
/// across-edge variance explains the overlap samples in every direction (least squares of
/// d² = k²/3·bᵀAb, b the sample's across-edge gradient); its range part the scatter about the
/// board's plane along the ray, at the edge itself, less what beam jitter makes of the slant.
/// `paired` is the plain covariance of the residuals to the nearest boundary points.
struct ResponseStatistics {
  int n = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_sigma = Eigen::Vector3d::Zero();  ///< Its standard deviation.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d std_sigma = Eigen::Vector3d::Zero();  ///< Of the roots of the diagonal.
  Eigen::Matrix3d paired = Eigen::Matrix3d::Zero();
  [[nodiscard]] Eigen::Vector3d std_dev() const { return covariance.diagonal().cwiseSqrt(); }
};

/// Statistics of one class of range and incidence.
struct ResponseCell {
  double range_low_m = 0.0, range_high_m = 0.0;
  double incidence_low_deg = 0.0, incidence_high_deg = 0.0;
  std::optional<ResponseStatistics> statistics;  ///< Nothing with fewer than min_samples.
  int n = 0;
};

struct SceneResponse {
  std::string name;
  std::vector<NodeResponse> nodes;
  std::vector<BoundarySample> samples;  ///< The region of interest about the used nodes.
  std::optional<TransitionFit> transition;
  /// Standard deviation of the overlap region's width over that width.
  double relative_width_sigma = 0.0;
  std::optional<ResponseStatistics> statistics;
  Message reason;  ///< Why there are none; empty otherwise.
};

struct BoundaryResponse {
  std::vector<SceneResponse> scenes;
  std::optional<TransitionFit> transition;  ///< Of all scenes, levels taken from each.
  std::optional<ResponseStatistics> all;
  std::vector<ResponseCell> by_range;
  std::vector<ResponseCell> by_incidence;
  std::vector<ResponseCell> by_both;
  /// Share of the angular covariance that moves the ranges on slanted boards: 1 when all of it is
  /// jitter of the beam's axis, 0 when all of it is footprint. Sigma 0: the scenes cannot tell.
  double jitter_share = 0.0;
  double jitter_share_sigma = 0.0;
  Message reason;  ///< Why there are no statistics; empty otherwise.
};

/// What the calibration needs of one scene; what is pointed to must outlive the call.
struct ResponseInput {
  std::string name;
  const Cloud* board_points = nullptr;
  const BoardRefinement* refinement = nullptr;
  /// Parts of the board that something covers: no sample is taken there.
  std::vector<Eigen::AlignedBox2d> covered = {};
};

/// Calibrates the boundary response. Scenes run at the same time. Never fails for want of data:
/// scenes, nodes and statistics that cannot be had carry their reason. Errors: kCancelled.
Result<BoundaryResponse> calibrate_boundary_response(const std::vector<ResponseInput>& scenes,
                                                     const Target& target,
                                                     const ResponseOptions& options,
                                                     const RunContext& context);

}  // namespace lvcalib
