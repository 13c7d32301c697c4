// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "solve/global_solution.h"
#include "solve/print_match.h"
#include "solve/print_size.h"
#include "solve/scan_faults.h"

namespace lvcalib {

struct ForwardOptions {
  ReturnSelection selection;
  PrintSearch search;
  double robust_threshold = 3.0;  ///< Huber's, in standard deviations.
  double patch_m = 0.2;           ///< Side of the patches over which the print may move.
  int max_iterations = 30;
  /// Done when a step moves the extrinsic by less than this share of its standard deviation, or all
  /// steps still to come would; one more is taken then.
  double tolerance = 0.03;
  double sigma_px_floor = 0.01;
  /// A kind of shared error is taken into the model if chance alone makes it look as large so
  /// rarely.
  double false_alarm = 0.01;
  /// Standard deviations of what is known of the intrinsics (fx fy cx cy, distortion); 0: held.
  Eigen::Matrix<double, kIntrinsics, 1> intrinsics_sigma =
      Eigen::Matrix<double, kIntrinsics, 1>::Zero();
  /// Where freed intrinsics start; without it at the given camera, to which they are drawn anyway.
  std::optional<Camera> first_camera;
  /// What further images say about the intrinsics.
  std::optional<IntrinsicsEvidence> intrinsics_evidence;
  /// First guess of the beam's blur, rad: between a Livox (1 mrad) and a spinning 16-liner (3).
  double first_blur_rad = 0.0015;
};

/// What the joint solve is given. Refers to all of it.
struct ForwardInput {
  const std::vector<ForwardScene>& scenes;
  const BlurredPrint& print;
  const Camera& camera;
  Rigid3 camera_from_lidar;  ///< Start.
  double corner_sigma_px = 0.0;
};

/// What the solve says about one scene.
struct ForwardSceneResult {
  std::size_t returns = 0;  ///< Rows in use.
  std::size_t on_board = 0;
  std::size_t refused = 0;
  std::vector<CoveredPatch> covered;  ///< Parts of the board that something covers.
  /// Share of the intensities' variance that the model leaves.
  double intensity_left = 1.0;
  double range_chi = 0.0, intensity_chi = 0.0, corner_chi = 0.0;  ///< RMS in σ.
  SceneNoise noise;
  /// Before the joint solve, of the print alone: correlation (0: the print is not seen, and the
  /// intensities are not used), and the log-likelihood by which its place beats the best other one.
  double print_correlation = 0.0;
  double print_margin = 0.0;
  double intensity_structure = 1.0;  ///< See intensity_structure().
  double saturated = 0.0;            ///< See BoardReturns.
  double seen = 1.0;                 ///< Share of the board, in sixteenths, that holds returns.
  PrintSize print_size;              ///< As the returns show it.
};

/// The extrinsic and all else that the base model holds.
struct ForwardSolution {
  /// Covariance of the left perturbation in the camera frame, shared errors included.
  UncertainRigid3 camera_from_lidar;
  /// Student's, by Satterthwaite's approximation: how well the variances of shared errors and of
  /// the corners are known.
  double dof = 0.0;
  ForwardState state;
  ForwardNoise noise;
  Eigen::Matrix3d blur_covariance = Eigen::Matrix3d::Zero();  ///< Of (hh, hv, vv), rad⁴.
  std::vector<ForwardSceneResult> scenes;
  std::vector<GlobalTerm> terms;  ///< What each scene says about the globals, at the solution.
  std::vector<FaultTerm> faults;  ///< Per scene, for total_covariance().
  std::vector<ScanFault> scan_faults;
  GlobalPrior prior;
  Eigen::MatrixXd globals_covariance;  ///< Of all globals, prior included; zero where held.
  int iterations = 0;
  bool converged = false;
  bool uses_intensity = false;
  /// Log-likelihood, over all scenes, by which the print's place beats the best place elsewhere;
  /// the likelihood of no print at all if there is no other place. Divided by the variance
  /// inflation.
  double lattice_margin = 0.0;
  /// Size of the print over all scenes.
  PrintSize print_size;
};

/// The extrinsic that some of the scenes give (`use` per scene), to first order about the solution
/// of all, with the noise of all. Nothing if they do not determine it.
std::optional<UncertainRigid3> solve_subset(const ForwardSolution& solution,
                                            const std::vector<bool>& use);

/// The joint solve: every corner, every range and every intensity on the boards, one extrinsic,
/// one pose per board, one beam (Gauss–Newton; scenes eliminated; shared errors marginalised with
/// variances estimated by restricted maximum likelihood). The start may be off by some centimetres:
/// the print is matched scene by scene first, and the scenes' votes compared over all scenes.
/// Errors (kUntrusted): no scene with returns on its board; not solvable. kCancelled.
Result<ForwardSolution> solve_forward(const ForwardInput& input, const ForwardOptions& options,
                                      const RunContext& context);

}  // namespace lvcalib
