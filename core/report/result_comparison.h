// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/error.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "pipeline/calibration.h"

namespace lvcalib {

/// An extrinsic and what is known of its errors: from a result, or the truth of a simulation.
struct StatedExtrinsic {
  Rigid3 camera_from_lidar;
  /// Of the noise alone, and with what faults left out of the model could still do; of the left
  /// perturbation, m and rad. Zero where nothing is stated.
  Matrix6d covariance = Matrix6d::Zero();
  Matrix6d covariance_total = Matrix6d::Zero();
  bool is_truth = false;  ///< Without errors.
  [[nodiscard]] bool states_errors() const { return is_truth || covariance_total.trace() > 0.0; }
};

/// What a result states of one scene.
struct StatedScene {
  std::string name;
  bool used = true;
  /// Root mean squares of its corners and of its LiDAR residuals; absent where nothing is stated.
  std::optional<double> rms_px, rms_mm;
};

/// What two results are compared by.
struct StatedResult {
  StatedExtrinsic extrinsic;
  std::vector<StatedScene> scenes;  ///< None of a truth.
  std::string dataset;              ///< Where the scenes are from; empty if it is not stated.
};

/// A calibration as its result file would state it.
StatedResult stated_result(const CalibrationResult& result);

/// Reads a result.json, a result.yaml (by its suffix), or the truth of a simulation (T_CL).
/// Errors (kInput): none of them.
Result<StatedResult> read_stated_result(const std::filesystem::path& path);

/// Whether two results rest on the same scenes: the difference is then that of the models, and
/// smaller than both uncertainties together allow.
bool share_scenes(const StatedResult& first, const StatedResult& second);

/// One scene in either result; absent where a result does not know it.
struct SceneComparison {
  std::string name;
  std::optional<StatedScene> first, second;
};

/// The scenes of both by name, in the order of the first, then those of the second alone.
std::vector<SceneComparison> compare_scenes(const StatedResult& first, const StatedResult& second);

/// Where points of the LiDAR fall in the picture under either of two extrinsics.
struct ProjectionShift {
  std::vector<Eigen::Vector2d> first_px, second_px;  ///< Only of points that both image.
  double rms_px = 0.0;                               ///< Of second − first.
  double largest_px = 0.0;
};
ProjectionShift projection_shift(std::span<const Eigen::Vector3d> points_in_lidar_m,
                                 const Camera& camera, const Rigid3& first_camera_from_lidar,
                                 const Rigid3& second_camera_from_lidar);

/// The same for a grid over the board of a scene, where the LiDAR has it. Nothing if it was not
/// found there.
std::optional<ProjectionShift> board_shift(const CalibrationResult& result,
                                           const SceneResult& scene,
                                           const Rigid3& first_camera_from_lidar,
                                           const Rigid3& second_camera_from_lidar);

/// How far one extrinsic is from another, in the camera's axes.
struct ExtrinsicDifference {
  double translation_mm = 0.0;  ///< Between the two LiDAR origins.
  double rotation_mrad = 0.0;
  /// Log(second · first⁻¹), x y z in m, then the rotation in rad.
  Vector6d by_axis = Vector6d::Zero();
  /// Standard deviations of either (total), and of the difference if both come from data of their
  /// own; zero where nothing is stated.
  Vector6d sigma_first = Vector6d::Zero();
  Vector6d sigma_second = Vector6d::Zero();
  Vector6d sigma = Vector6d::Zero();
  /// δᵀ(C₁ + C₂)⁻¹δ with the total covariances; 6 degrees of freedom. Absent if one states none.
  std::optional<double> chi2;
  /// How likely such a difference or a larger one is by chance, if both state their errors.
  std::optional<double> probability;
};
ExtrinsicDifference difference_of(const StatedExtrinsic& first, const StatedExtrinsic& second);

}  // namespace lvcalib
