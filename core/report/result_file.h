// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "pipeline/calibration.h"
#include "report/frame_names.h"

namespace lvcalib {

/// Larger result files are refused.
inline constexpr std::size_t kMaxResultBytes = std::size_t{256} << 20;

/// The library's version, as in result files.
std::string version();

/// The calibration as the text of result.json (keys: see resources/guide/files.md).
std::string result_as_json(const CalibrationResult& result, const FrameNames& frames = {});

/// The short form for people and YAML readers: pose, uncertainty, quality, scenes.
std::string result_as_yaml(const CalibrationResult& result, const FrameNames& frames = {});

/// Writes result.json and result.yaml into a folder (created if needed): both of one run, or none.
Status write_results(const CalibrationResult& result, const std::filesystem::path& folder,
                     const FrameNames& frames = {});

/// What `evaluate` needs of a result file.
struct StoredExtrinsic {
  Rigid3 camera_from_lidar;
  Matrix6d covariance = Matrix6d::Zero();  ///< Zero if the file has none.
};

/// Reads T_camera_lidar and its covariance from result.json.
Result<StoredExtrinsic> read_result(const std::filesystem::path& path);
/// The same from the text of a result.json, as if it stood in a file `path`.
Result<StoredExtrinsic> result_from_json(const std::string& text,
                                         const std::filesystem::path& path);

/// What `evaluate` needs of one step of a result's ablation.
struct StoredStep {
  std::string name;
  double rms_px = 0.0;
  double rms_mm = 0.0;
  Rigid3 camera_from_lidar;
};

/// Reads the ablation from result.json; empty if it has none.
Result<std::vector<StoredStep>> read_ablation(const std::filesystem::path& path);

/// Reads T_CL from a truth.json of the simulator.
Result<Rigid3> read_truth(const std::filesystem::path& path);

/// Errors of an extrinsic against the truth.
struct ExtrinsicError {
  double translation_mm = 0.0;  ///< Distance between the two LiDAR origins in the camera frame.
  double rotation_mrad = 0.0;
  Vector6d left_perturbation = Vector6d::Zero();  ///< Log(truth · estimate⁻¹), m and rad.
  /// Each component over its standard deviation; NaN without a covariance.
  Vector6d normalized = Vector6d::Zero();
};
ExtrinsicError compare_extrinsics(const StoredExtrinsic& estimate, const Rigid3& truth);

}  // namespace lvcalib
