// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/error.h"

namespace lvcalib {

enum class DistortionModel {
  kPlumbBob,            ///< k1 k2 p1 p2 k3
  kRationalPolynomial,  ///< k1 k2 p1 p2 k3 k4 k5 k6
  kEquidistant,         ///< k1 k2 k3 k4 (Kannala–Brandt fisheye)
};

/// A calibrated camera. Camera frame: x right, y down, z forward. Pixels as in OpenCV: the centre
/// of the top-left pixel is (0, 0).
struct Camera {
  int width_px = 0;
  int height_px = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  DistortionModel model = DistortionModel::kPlumbBob;
  /// Always 8 long; entries the model does not use are zero.
  Eigen::Matrix<double, 8, 1> distortion = Eigen::Matrix<double, 8, 1>::Zero();
  std::string name;

  /// Number of distortion coefficients of the model: 5, 8 or 4.
  [[nodiscard]] int distortion_count() const;

  /// Projects a point of the camera frame (m) to pixels. Nothing for points that the model cannot
  /// image (behind the camera; beyond the radius where the distortion folds back).
  /// Optional analytic Jacobians: by the point (2×3) and by the intrinsics
  /// (2×12: fx fy cx cy, then the 8 distortion entries).
  [[nodiscard]] std::optional<Eigen::Vector2d> project(
      const Eigen::Vector3d& point_m, Eigen::Matrix<double, 2, 3>* by_point = nullptr,
      Eigen::Matrix<double, 2, 12>* by_intrinsics = nullptr) const;

  /// Unit direction of the ray through a pixel: the inverse of project().
  /// Nothing if the model has no such ray.
  [[nodiscard]] std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& pixel) const;

  [[nodiscard]] bool in_image(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < width_px - 0.5 &&
           pixel.y() < height_px - 0.5;
  }
};

/// A camera read from a file, with warnings about unknown keys.
struct CameraFile {
  Camera camera;
  std::vector<Message> warnings;
};

/// Reads intrinsics; ROS camera_info, Kalibr camchain and OpenCV FileStorage are told apart by
/// their keys. A camchain with several cameras gives the first one and a warning.
Result<CameraFile> read_camera(const std::filesystem::path& path);

/// The model's name in ROS camera_info: "plumb_bob", "rational_polynomial", "equidistant".
std::string name_of(DistortionModel model);

/// The camera as ROS camera_info YAML.
std::string to_yaml(const Camera& camera);

/// Checks sizes, focal lengths and principal point for plausibility.
Status check(const Camera& camera);

}  // namespace lvcalib
