// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include <Eigen/Core>

#include "detection/blurred_tag.h"

namespace lvcalib {

/// Corners of the black square in tag coordinates, in the order of TagCorners.
inline const std::array<Eigen::Vector2d, 4> kTagCorners = {
    Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, -1), Eigen::Vector2d(1, 1), Eigen::Vector2d(-1, 1)};

/// Homography that takes the four corners of the tag to four points of a plane.
Eigen::Matrix3d plane_from_tag_corners(const std::array<Eigen::Vector2d, 4>& points);

/// What determines the grey values of a printed tag in an image, up to noise:
/// gray = B(u, v) + C(u, v)·(a + k·a(1 − a)), where a is the blurred albedo at (u, v), the tag
/// point of the pixel, B and C are linear over the tag, and k bends the camera's response. Edges
/// run along the tag's axes: where black has grown by g all around one sees what lay at
/// (u − g·sign aᵤ, v − g·sign aᵥ) before, taken to second order in g.
struct TagModel {
  /// Order of the unknowns: homography (8), blur, bend k, black level and its slopes by u and v,
  /// contrast and its slopes, growth of black.
  static constexpr int kBlur = 8, kCurve = 9, kBlack = 10, kContrast = 13, kGrowth = 16;
  static constexpr int kUnknowns = 17;
  using Vector = Eigen::Matrix<double, kUnknowns, 1>;

  Eigen::Matrix3d tag_from_plane = Eigen::Matrix3d::Identity();
  double blur_px = 1.0;
  double curve = 0.0;
  double growth = 0.0;  ///< Of all black edges outwards, tag coordinates: ink that has spread.
  Eigen::Vector3d black = Eigen::Vector3d::Zero();
  Eigen::Vector3d contrast = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector2d tag_point(const Eigen::Vector2d& plane) const;
  [[nodiscard]] Eigen::Vector2d plane_point(const Eigen::Vector2d& tag) const;
  /// The outer corners on the plane.
  [[nodiscard]] std::array<Eigen::Vector2d, 4> plane_corners() const;
  /// Jacobian of tag_point().
  [[nodiscard]] Eigen::Matrix2d tag_by_plane(const Eigen::Vector2d& plane) const;
  /// Motion of a tag point by the first eight entries of a step: the homography changes to
  /// (I + Δ)·tag_from_plane with Δ filled row by row, its last entry zero.
  static Eigen::Matrix<double, 2, 8> tag_by_homography_step(const Eigen::Vector2d& tag);

  /// Grey value at a point of the plane and, if asked for, its derivatives by the unknowns at a
  /// zero step. Neglected: the change of the blur's shape with the homography, and what the growth
  /// does to the derivatives to second order.
  double gray(const BlurredTag& tag, const Eigen::Matrix2d& plane_by_pixel,
              const Eigen::Vector2d& plane, Vector* by_step = nullptr) const;

  /// The model after a step; blur, bend and growth are kept within what is possible.
  [[nodiscard]] TagModel moved(const Vector& step) const;
};

}  // namespace lvcalib
