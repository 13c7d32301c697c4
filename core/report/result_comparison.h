// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "base/error.h"
#include "base/rigid3.h"

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

/// Reads a result.json, or the truth of a simulation (T_CL). Errors (kInput): neither of both.
Result<StatedExtrinsic> read_stated_extrinsic(const std::filesystem::path& path);

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
