// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <Eigen/Core>

#include "camera/camera.h"
#include "simulation/disturbances/effect_plan.h"

namespace lvcalib::simulation {

/// How the camera departs from its calibration file. Image errors are seen − predicted by the file.
///
/// Intrinsics: focal lengths larger by a share s, the principal point off by s times the focal
/// length in a random direction. Residual distortion: 0.8 ρ³ + 0.2 ρ⁵ outwards (ρ = 1 in the image
/// corner), and decentring of 30 % of it. Lens flaw: a Gaussian patch, 6 % of the image width wide,
/// that displaces the image. Rolling shutter: the camera turns to the left at an even rate from
/// the first row, in which the scene's pose is true, to the last.
/// Corner bias: see CornerShift.
class CameraDisturbance {
 public:
  CameraDisturbance() = default;
  CameraDisturbance(EffectPlan& plan, const Camera& nominal);

  [[nodiscard]] bool bends_rays() const { return bends_rays_; }

  /// The ray that a pixel truly sees, in the camera frame.
  [[nodiscard]] std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& pixel) const;

  /// More than any point of the board moves in the image.
  [[nodiscard]] double reach_px() const { return reach_px_; }

  /// How far a tag's corners are seen outside their place.
  [[nodiscard]] double corner_bias_px() const { return corner_bias_px_; }

 private:
  [[nodiscard]] Eigen::Vector2d displacement_px(const Eigen::Vector2d& pixel) const;

  Camera camera_;  // With its true intrinsics.
  bool bends_rays_ = false;
  double reach_px_ = 0.0;
  double corner_bias_px_ = 0.0;
  double radial_px_ = 0.0;
  double corner_px_ = 1.0;
  Eigen::Vector2d decentring_px_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d flaw_px_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d flaw_center_px_ = Eigen::Vector2d::Zero();
  double flaw_sigma_px_ = 1.0;
  double shutter_px_ = 0.0;
};

}  // namespace lvcalib::simulation
