// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "cloud/cloud.h"
#include "detection/board_view.h"
#include "verification/image_edges.h"
#include "verification/lidar_edges.h"

namespace lvcalib {

/// A photograph and the cloud that was taken with it, made ready for comparing their edges.
struct EdgeView {
  std::string name;
  std::vector<LidarEdge> lidar_edges;
  std::shared_ptr<const ImageEdges> image_edges;
};

/// Finds the edges of both. Where the cloud's order is lost, it looks about where `rough` has the
/// camera's axis.
/// Errors (kInput): an image of another size than the camera's; no edge in the image or the cloud.
Result<EdgeView> edge_view(std::string name, const GrayImage& image, const Cloud& cloud,
                           const Camera& camera, const Rigid3& rough_camera_from_lidar);

/// How well edges agree at one pose.
struct EdgeScore {
  /// Share of the LiDAR's edges that lie on one of the image, above what chance gives: 0 chance, 1
  /// all. An edge d pixels off counts exp(−d²/2s²), s twice what the LiDAR's spacing leaves open of
  /// where it is (a twelfth of its square is the variance, and kImageEdge_px² the image's); chance
  /// is what the same edges count when they are shifted elsewhere in the image.
  double score = 0.0;
  double sigma = 0.0;  ///< One standard deviation of it, from parts of the image.
  double chance = 0.0;
  std::size_t edges = 0;  ///< Of the LiDAR in the picture.
};

/// An edge of the LiDAR in the picture, for drawing.
struct ProjectedEdge {
  Eigen::Vector2d pixel;
  double count = 0.0;  ///< 0 no edge of the image is near, 1 it lies on one.
};

/// What the edge of a surface in the image is off from where a beam finds it, one σ: blur, shadow,
/// what is not quite flat.
inline constexpr double kImageEdge_px = 0.7;

/// The score at a pose. Fast enough to follow a hand: a lookup for each edge.
EdgeScore edge_score(const std::vector<EdgeView>& views, const Camera& camera,
                     const Rigid3& camera_from_lidar);

/// Where a view's edges of the LiDAR are at a pose.
std::vector<ProjectedEdge> projected_edges(const EdgeView& view, const Camera& camera,
                                           const Rigid3& camera_from_lidar);

struct EdgeCheckOptions {
  /// How far the pose may be off at most: the prior's standard deviations.
  double reach_m = 0.2;
  double reach_rad = 0.03;
  /// Covariance of the calibration's own pose (left perturbation, camera frame), if it states one.
  std::optional<Matrix6d> covariance;
  /// Edges that agree to this are taken to agree: light, shadow and round things move the edge that
  /// a camera sees against that which a beam meets, by an amount that no statistics of one place
  /// tells.
  double tolerance_px = 1.0;
};

/// What became of a check, and why; the last three cannot tell.
enum class EdgeVerdict {
  kAgrees,       ///< Nothing contradicts the calibration.
  kContradicts,  ///< The pose has changed, or it was wrong.
  kFewEdges,     ///< Too few edges of the LiDAR are in the picture, or in too few parts of it.
  kNoMeeting,    ///< The edges meet no better than by chance, at the given pose and nearby.
  kUncertain,    ///< Where the edges agree is known too badly.
};

/// What edges say of a calibration.
struct EdgeCheck {
  EdgeVerdict verdict = EdgeVerdict::kFewEdges;
  std::size_t parts = 0;  ///< Of the picture, that edges are in.
  EdgeScore given;        ///< At the calibration's pose.
  EdgeScore best;         ///< Where the edges agree best.
  /// How much more of the edges lie on one of the image there, of those in the picture at both.
  double gain = 0.0;
  double gain_sigma = 0.0;
  double gain_that_matters = 0.0;  ///< What edges that are off by the tolerance would gain.
  /// From the given pose to the best one: left perturbation in the camera frame (m, rad), with its
  /// covariance; the prior is in it.
  Vector6d offset = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Zero();
  Rigid3 best_pose;
  double offset_px = 0.0;  ///< Root mean square over the edges of what it does in the picture.
  double offset_sigma_px = 0.0;  ///< What chance would do there.
  double widening_mrad = 0.0;    ///< By how much range edges stand outside of what is seen.
  /// A turn about the camera's axes x, y, z that would be noticed in nine cases of ten by its σ,
  /// rad; in simulated rooms it was in three of four with one place, in nine of ten with three.
  Eigen::Vector3d noticed_turn_rad = Eigen::Vector3d::Zero();
};

/// Estimates the pose where the edges agree best and judges the given one.
///
/// Every LiDAR edge is drawn to the nearest image edge that its scan would cross; its distance
/// along that edge's normal counts with Welsch's weight exp(−d²/2s²), s from the reach down to the
/// score's. Range edges may all stand outside of the true ones by one angle, as a beam of finite
/// width sees them: an unknown of its own. The covariance is the sandwich estimator (Huber 1967)
/// over parts of the image, as neighbours share an edge and what is wrong with it. Errors: kUsage
/// without views; kCancelled.
Result<EdgeCheck> check_edges(const std::vector<EdgeView>& views, const Camera& camera,
                              const Rigid3& camera_from_lidar, const EdgeCheckOptions& options,
                              const RunContext& context);

/// What a check needs at least to tell anything.
inline constexpr std::size_t kLeastEdges = 40;
inline constexpr std::size_t kLeastEdgeParts = 8;

/// "agrees", "contradicts", "cannot tell".
std::string name_of(EdgeVerdict verdict);
/// The verdict's reason in a sentence.
Message reason_of(const EdgeCheck& check);

}  // namespace lvcalib
