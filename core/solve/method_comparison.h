// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solve/feature_solver.h"
#include "solve/uncertainty_report.h"

namespace lvcalib {

/// How well a method's extrinsic explains one scene.
struct MethodScene {
  std::string name;
  double rms_px = 0.0;
  double rms_mm = 0.0;
  std::vector<double> errors_px;  ///< Every used corner's distance, for distributions.
  std::vector<double> errors_mm;  ///< Every used node's distance.
  /// The same two with the method solved without this scene; empty with fewer than two scenes.
  std::optional<double> heldout_px;
  std::optional<double> heldout_mm;
};

/// One way to an extrinsic, and how it does.
///
/// All methods are measured alike, by the refined nodes and the corners of the same scenes: with
/// the method's extrinsic held, each scene's board pose is set where corners, nodes and plane
/// together fit best (the joint objective). What then remains at corners (px) and nodes (mm) is
/// what the extrinsic cannot explain. For joint_refined these are the solve's own residuals.
struct MethodResult {
  std::string name;  ///< svd_raw … joint_refined as in the paper's table, and further ways.
  Rigid3 camera_from_lidar;
  double rms_px = 0.0;
  double rms_mm = 0.0;
  /// Corners predicted from the LiDAR alone: π(T_camera_lidar · T_lidar_board · P) against the
  /// corners found. Shows an extrinsic's error undiminished by the board poses.
  double transfer_px = 0.0;
  std::optional<double> heldout_px;
  std::optional<double> heldout_mm;
  double translation_mm = 0.0;  ///< Difference to joint_refined: LiDAR origin in the camera frame.
  double rotation_mrad = 0.0;
  std::vector<MethodScene> scenes;  ///< The scenes in use.
};

/// A solution from elsewhere that is measured like the others.
struct OtherMethod {
  std::string name;
  Rigid3 camera_from_lidar;
  SubsetSolver subset;  ///< Solves it without a scene.
};

/// The joint objective in another form, perhaps with nodes measured otherwise. Solved as stated, on
/// all corners and valid nodes of the scenes in use: nothing widened, nothing left out.
struct JointVariant {
  std::string name;
  std::vector<SceneObservations> scenes;  ///< Those of the comparison, in its order.
  ExtrinsicOptions options;
};

/// The options of the paper's joint objective: corners over σ_px, each node's three coordinates
/// over its one σ, squares alone. σ_px, for which the paper prints no number, is the corners' own.
ExtrinsicOptions paper_objective(ExtrinsicOptions options);

struct MethodOptions {
  bool held_out = true;  ///< Solve every method once more without each scene.
  /// With nodes as the paper refines them and paper_objective(): its method as it is printed.
  std::optional<JointVariant> paper = {};
  std::optional<OtherMethod> other = {};
  int threads = 1;
};

/// The paper's comparison (LV-Calib, section IV-C) on the scenes, tags and nodes that the joint
/// solve uses:
/// svd — nodes by the camera's board pose against nodes by the LiDAR, closed form;
/// wsvd — the same, each pair weighted by the variance of both its ends;
/// pnp — LiDAR nodes projected onto the nodes' pixels by the camera's board pose;
/// joint — the joint objective.
/// Each with the centres as initialised (raw) and as refined. Boards without circles have no nodes
/// to compare: joint_refined alone is listed, its rms_mm the heights over the planes.
/// Behind them `paper`, and `other`, the joint solve over every return.
std::vector<MethodResult> compare_methods(const FeatureInput& in, const ExtrinsicSolution& joint,
                                          const MethodOptions& options = {});

/// Variants of the joint objective, measured as compare_methods() does. Those that fewer than three
/// nodes leave undetermined are not listed.
std::vector<MethodResult> compare_variants(const FeatureInput& in, const ExtrinsicSolution& joint,
                                           const std::vector<JointVariant>& variants);

}  // namespace lvcalib
