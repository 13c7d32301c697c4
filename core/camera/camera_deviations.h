// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "base/error.h"
#include "camera/camera.h"

namespace lvcalib {

/// How well intrinsics are known, as their file says under `standard_deviations: {fx, fy, cx, cy
/// (px), distortion: […] (1)}`: fx fy cx cy, then eight distortion entries. Negative: not stated
/// there. 0: exact.
using CameraDeviations = Eigen::Matrix<double, 12, 1>;

/// Reads them from an intrinsics file; nothing where it has no such key. Errors (kInput): a value
/// that is no number or below zero, more distortion entries than the model has.
Result<std::optional<CameraDeviations>> read_camera_deviations(const std::filesystem::path& path,
                                                               const Camera& camera);

/// The camera as ROS camera_info YAML with its standard deviations, as read_camera() and
/// read_camera_deviations() read them. What is not stated is left out; of the distortion all that
/// stands before the first such entry is written.
std::string to_yaml(const Camera& camera, const CameraDeviations& deviations);

}  // namespace lvcalib
