// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/error.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "cloud/plane.h"
#include "detection/board_view.h"
#include "refinement/board_refinement.h"
#include "target/target.h"

namespace lvcalib {

/// Planes and corners leave the LiDAR's place open: a target without circles needs so many scenes.
inline constexpr int kFewestWithoutCircles = 3;

/// Everything the joint solve needs of one scene.
struct SceneObservations {
  std::string name;
  bool use = true;
  std::vector<CornerObservation> corners;
  Rigid3 camera_from_board;        ///< Start value, from the corners alone.
  FittedPlane plane;               ///< The board's plane in the LiDAR frame.
  Rigid3 lidar_from_board;         ///< From the LiDAR alone.
  std::vector<RefinedNode> nodes;  ///< Empty for targets without circles.
};

/// What of a node takes part in the joint objective.
enum class NodeTerm {
  kInPlane,    ///< Its place in the plane by its covariance; the plane has a term of its own.
  kAllAxes,    ///< All three axes: in the plane by its covariance, along the normal by its σ.
  kIsotropic,  ///< All three axes by its one σ, as the paper prints it.
};

struct ExtrinsicOptions {
  NodeTerm node_term = NodeTerm::kInPlane;
  double sigma_px_floor = 0.01;       ///< Corner noise is never taken below this.
  double node_sigma_floor_m = 5e-5;   ///< Added in quadrature to every node's standard deviation.
  double plane_sigma_floor_m = 2e-5;  ///< Added in quadrature to the plane's height.
  double robust_threshold = 4.0;      ///< Huber threshold in standard deviations.
  double rejection_gate = 5.0;        ///< A tag or node farther off (in σ) is left out.
  bool reject_bad_scenes = true;      ///< Leave out scenes that contradict all others.
  double scene_rejection_gain = 5.0;  ///< So many times better the rest must fit without it.
  double false_alarm = 0.01;  ///< Chance of widening a stated σ though only noise is at work.
  double weak_direction_ratio = 10.0;  ///< A direction so many times worse than usual is weak.
  int max_iterations = 50;
};

/// What a solve by features is given, and functions of it pass on.
struct FeatureInput {
  const std::vector<SceneObservations>& scenes;
  const Camera& camera;
  const Target& target;
  const ExtrinsicOptions& options;
};

/// One corner's residual (measured − predicted).
struct CornerResidual {
  int feature_id = 0;
  int corner = 0;
  Eigen::Vector2d residual_px = Eigen::Vector2d::Zero();
  bool used = true;
};

/// One node's residual: T_board_camera·T_camera_lidar·p − P, in the board frame.
struct NodeResidual {
  int id = 0;
  Eigen::Vector3d residual_m = Eigen::Vector3d::Zero();
  bool used = true;
};

struct SceneSolution {
  std::string name;
  bool used = false;
  Message reason;  ///< Why it is not used.
  Rigid3 camera_from_board;
  double rms_px = 0.0;
  double rms_mm = 0.0;  ///< Of the node residuals; of the plane's heights without nodes.
  std::vector<CornerResidual> corners;
  std::vector<NodeResidual> nodes;
  /// Whether a node took part; without one only the plane tells of the LiDAR.
  [[nodiscard]] bool uses_nodes() const {
    return std::any_of(nodes.begin(), nodes.end(), [](const NodeResidual& n) { return n.used; });
  }
};

/// How the extrinsic moves when one scene is left out.
struct LeaveOneOut {
  std::string without;
  double translation_mm = 0.0;
  double rotation_mrad = 0.0;
};

/// Result of the joint solve.
struct ExtrinsicSolution {
  /// Covariance of the left perturbation in the camera frame, order tx ty tz rx ry rz.
  UncertainRigid3 camera_from_lidar;
  std::vector<SceneSolution> scenes;
  std::vector<LeaveOneOut> leave_one_out;
  double rms_px = 0.0;
  double rms_mm = 0.0;
  double sigma_px = 0.0;     ///< Corner noise estimated from the residuals.
  double node_scale = 1.0;   ///< Factor on the nodes' stated σ that the residuals ask for (≥ 1).
  double plane_scale = 1.0;  ///< The same for the planes.
  int rank = 6;              ///< Directions of the extrinsic that the scenes determine.
  std::vector<Message> weak_directions;  ///< In words; empty when none is.
  int used_scenes = 0;
  [[nodiscard]] bool uses_nodes() const {
    return std::any_of(scenes.begin(), scenes.end(),
                       [](const SceneSolution& s) { return s.used && s.uses_nodes(); });
  }
};

/// Joint weighted solve over T_camera_lidar and every board pose (LV-Calib, section III-C):
/// corners by reprojection with σ estimated from the data; LiDAR nodes with the covariance of
/// their refinement; the board planes with theirs. For targets without circles corners and
/// planes alone. Robust against single bad tags, nodes and scenes.
/// Errors (kUntrusted): no scenes; fewer than three scenes without nodes; not solvable.
Result<ExtrinsicSolution> solve_extrinsic(const FeatureInput& in);

/// Closed-form start: aligns board points seen by both sensors (Kabsch) over the used scenes.
Rigid3 closed_form_extrinsic(const std::vector<SceneObservations>& scenes, const Target& target);

}  // namespace lvcalib
