// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "base/message.h"
#include "base/progress.h"
#include "base/rigid3.h"
#include "cloud/cloud.h"
#include "cloud/plane.h"
#include "target/target.h"

namespace lvcalib {

/// How the centres of the circles are measured.
enum class CenterEstimator {
  /// The error-function profile of a footprint common to all circles, see refine_board().
  kTransition,
  /// As the paper prints it: in every bin the medians of the two levels and the mid-level between
  /// them by linear interpolation of the profile; bins weighted by contrast and support, none left
  /// out for contradicting the others; the centres are those of the layout, each with one σ from
  /// the scatter of its midpoints. Footprint and noise stay what they were at the start.
  kMidpoint,
};

/// Options of the angle–distance refinement.
struct RefinementOptions {
  int max_bins = 24;              ///< Angular bins of a densely sampled node.
  int min_bins = 8;               ///< And of a sparse one.
  double samples_per_bin = 16.0;  ///< Wanted support; decides how many bins a node gets.
  int min_bin_samples = 4;        ///< A bin with fewer samples is refused.
  double min_contrast = 3.0;      ///< Smallest level difference, in units of the intensity noise.
  double max_step_m = 0.005;      ///< Largest correction of one iteration.
  double tolerance_m = 2e-5;      ///< Done when no node moves by more.
  int max_iterations = 30;
  CenterEstimator estimator = CenterEstimator::kTransition;
  /// A sample lies where its ray meets the plane; otherwise at its foot on the plane, where range
  /// noise moves it sideways on a tilted board.
  bool along_rays = true;
  /// Least σ of a centre by midpoints; the paper has such a floor and prints no number.
  double midpoint_sigma_floor_m = 1e-3;
};

/// The same options with the estimator as printed in the paper, on points projected to the plane.
RefinementOptions as_in_paper(RefinementOptions options);

enum class BinState {
  kUsed,
  kTooFewSamples,  ///< Fewer samples than min_bin_samples.
  kWeakContrast,   ///< The node's two levels do not stand clear of the noise.
  kOneSided,       ///< All samples lie on one side of the transition.
  kNoCrossing,     ///< The mid-level is not crossed inside the window.
  kOutlier,        ///< The midpoint contradicts the other bins of the node.
};

/// One line of plain words for a bin's state.
Message describe(BinState state);

/// One angular bin of one node in one iteration.
struct BinRecord {
  double angle_rad = 0.0;   ///< Information-weighted mean polar angle ψ.
  double midpoint_m = 0.0;  ///< Signed distance d* of the mid-level crossing.
  double sigma_m = 0.0;     ///< Its standard deviation.
  int samples = 0;
  BinState state = BinState::kTooFewSamples;
};

/// One node in one iteration.
struct NodeRecord {
  int id = 0;
  Eigen::Vector2d center_uv_m = Eigen::Vector2d::Zero();  ///< Centre at the start, in the plane.
  Eigen::Vector3d wave_m = Eigen::Vector3d::Zero();  ///< (Δc_u, Δc_v, Δr) of the fitted wave.
  double inner_level = 0.0;
  double outer_level = 0.0;
  std::vector<BinRecord> bins;
  bool valid = false;
  Message reason;  ///< Why it is not valid.
};

/// One iteration over all nodes.
struct IterationRecord {
  std::vector<NodeRecord> nodes;
  double max_update_m = 0.0;  ///< Largest move of a node after the projection to the layout.
  double transition_sigma_m = 0.0;
};

/// A node after the refinement.
struct RefinedNode {
  int id = 0;
  bool valid = false;
  Message reason;
  Eigen::Vector2d board_m = Eigen::Vector2d::Zero();  ///< Where the model has it.
  Eigen::Vector2d center_uv_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();  ///< Of center_uv_m.
  Eigen::Vector3d center_lidar_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d raw_lidar_m = Eigen::Vector3d::Zero();  ///< CAD transfer before refinement.
  int valid_bins = 0;
  /// Standard deviation per in-plane axis (root mean of the two variances).
  [[nodiscard]] double sigma_m() const;
};

/// The board in one LiDAR scene, refined.
struct BoardRefinement {
  FittedPlane plane;
  Rigid3 lidar_from_board;
  std::vector<RefinedNode>
      nodes;  ///< All nodes of the target, valid or not; empty without circles or contrast.
  std::vector<IterationRecord> history;
  bool converged = false;
  /// Covariance of the transition's blur in the plane (footprint and angular jitter), m².
  Eigen::Matrix2d footprint_m2 = Eigen::Matrix2d::Zero();
  double intensity_noise = 0.0;  ///< Of a single sample, over the level difference.
  double scale = 1.0;  ///< Size of the node layout measured by the LiDAR over the model's.
  double scale_sigma = 0.0;
  std::size_t board_points = 0;
  std::vector<Message> warnings;

  [[nodiscard]] int valid_nodes() const;
};

/// Sees a refinement while it runs; called from the thread that refines.
using RefinementObserver = std::function<void(const BoardRefinement& so_far)>;

/// Where the board's plane is, and the pose with it.
struct BoardPlane {
  FittedPlane plane;
  Rigid3 lidar_from_board;       ///< Place and turn of the start, normal of the plane.
  std::size_t board_points = 0;  ///< Inside the outline.
};

/// The plane of the board's points: those inside the outline at a start pose, white and black print
/// with a range noise each. Errors (kInput): fewer than ten points on the plane.
Result<BoardPlane> fit_board_plane(const Cloud& board_points, const Target& target,
                                   const Rigid3& lidar_from_board);

/// Angle–distance refinement of the circular nodes (LV-Calib, section III-B): plane; samples by
/// ray ∩ plane; per node and angular bin the mid-level crossing d*; the first-order wave
/// d* = Δc_u cos ψ + Δc_v sin ψ + Δr by weighted least squares; projection of all centres to the
/// scale-fixed layout; repeated until nothing moves.
///
/// The crossing is interpolated with the error-function profile of a Gaussian footprint whose
/// 2×2 covariance is estimated from all nodes together; each sample is weighted by the measured
/// variance at its distance, so that midpoints have true standard deviations.
///
/// For targets without circles, and where the intensity is missing or the same everywhere, only the
/// plane is fitted and `nodes` stays empty.
/// Errors (kInput): fewer than ten points on the plane.
/// `on_iteration` sees the refinement so far after each iteration: its plane and history.
Result<BoardRefinement> refine_board(const Cloud& board_points, const Target& target,
                                     const Rigid3& lidar_from_board,
                                     const RefinementOptions& options, const RunContext& context,
                                     const RefinementObserver& on_iteration = {});

/// The same on a plane that is known. Errors: cancelled.
Result<BoardRefinement> refine_nodes(const Cloud& board_points, const Target& target,
                                     const BoardPlane& plane, const RefinementOptions& options,
                                     const RunContext& context,
                                     const RefinementObserver& on_iteration = {});

}  // namespace lvcalib
