// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <Eigen/Core>

#include "camera/camera.h"

namespace lvcalib {

/// Map between a small part of an image and a plane on which straight lines stay straight: the
/// plane perpendicular to the patch's central ray, so that it works at any angle off the optical
/// axis. Pixels go to the plane by a quintic fitted to the camera model, which is exact to some
/// 1e-4 pixels over a tag and many times faster; the way back uses the camera model itself.
class UndistortedPatch {
 public:
  /// A patch around `center` of half width `radius_px`. Without a camera, the identity.
  /// Nothing if the camera has no rays there.
  static std::optional<UndistortedPatch> create(const Camera* camera,
                                                const Eigen::Vector2d& center_px, double radius_px);

  [[nodiscard]] Eigen::Vector2d to_plane(const Eigen::Vector2d& pixel) const;
  /// Jacobian of to_plane().
  [[nodiscard]] Eigen::Matrix2d plane_by_pixel(const Eigen::Vector2d& pixel) const;
  /// Nothing for points that the camera does not image.
  [[nodiscard]] std::optional<Eigen::Vector2d> to_pixel(const Eigen::Vector2d& plane) const;

 private:
  bool fit(const Camera& camera);
  [[nodiscard]] std::optional<Eigen::Vector2d> exact(const Eigen::Vector2d& pixel) const;

  const Camera* camera_ = nullptr;
  Eigen::Vector2d center_px_ = Eigen::Vector2d::Zero();
  double radius_px_ = 1.0;
  double scale_ = 1.0;  // plane units per unit of tangent: about one pixel
  Eigen::Matrix3d patch_from_camera_ = Eigen::Matrix3d::Identity();
  static constexpr int kTerms = 21;
  Eigen::Matrix<double, 2, kTerms> quintic_ = Eigen::Matrix<double, 2, kTerms>::Zero();
};

}  // namespace lvcalib
