// SPDX-License-Identifier: BSD-3-Clause
#include "detection/undistorted_patch.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

namespace lvcalib {
namespace {

using Basis = Eigen::Matrix<double, 10, 1>;

Basis basis(double x, double y) {
  Basis out;
  out << 1, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y;
  return out;
}

}  // namespace

std::optional<Eigen::Vector2d> UndistortedPatch::exact(const Eigen::Vector2d& pixel) const {
  const auto ray = camera_->unproject(pixel);
  if (!ray) return std::nullopt;
  const Eigen::Vector3d local = patch_from_camera_ * *ray;
  if (!(local.z() > 0.1)) return std::nullopt;
  return scale_ * local.head<2>() / local.z();
}

bool UndistortedPatch::fit(const Camera& camera) {
  const auto center = camera.unproject(center_px_);
  if (!center) return false;
  patch_from_camera_ =
      Eigen::Quaterniond::FromTwoVectors(*center, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  scale_ = 0.5 * (camera.fx + camera.fy);
  constexpr int kSteps = 5;
  Eigen::Matrix<double, kSteps * kSteps, 10> design;
  Eigen::Matrix<double, kSteps * kSteps, 2> values;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    // Denser towards the rim, as Chebyshev's nodes, against overshoot.
    const double x = std::cos((i % kSteps + 0.5) * M_PI / kSteps);
    const double y = std::cos((i / kSteps + 0.5) * M_PI / kSteps);
    const auto plane = exact(center_px_ + radius_px_ * Eigen::Vector2d(x, y));
    if (!plane) return false;
    design.row(i) = basis(x, y).transpose();
    values.row(i) = plane->transpose();
  }
  cubic_ = design.householderQr().solve(values).transpose();
  return cubic_.allFinite();
}

std::optional<UndistortedPatch> UndistortedPatch::create(const Camera* camera,
                                                         const Eigen::Vector2d& center_px,
                                                         double radius_px) {
  UndistortedPatch patch;
  patch.camera_ = camera;
  patch.center_px_ = center_px;
  patch.radius_px_ = radius_px;
  if (camera == nullptr) {
    patch.cubic_.col(0) = center_px;
    patch.cubic_(0, 1) = patch.cubic_(1, 2) = radius_px;
    return patch;
  }
  if (!patch.fit(*camera)) return std::nullopt;
  return patch;
}

Eigen::Vector2d UndistortedPatch::to_plane(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d p = (pixel - center_px_) / radius_px_;
  return cubic_ * basis(p.x(), p.y());
}

Eigen::Matrix2d UndistortedPatch::plane_by_pixel(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d p = (pixel - center_px_) / radius_px_;
  const double x = p.x();
  const double y = p.y();
  Eigen::Matrix<double, 10, 2> by;
  by.col(0) << 0, 1, 0, 2 * x, y, 0, 3 * x * x, 2 * x * y, y * y, 0;
  by.col(1) << 0, 0, 1, 0, x, 2 * y, 0, x * x, 2 * x * y, 3 * y * y;
  return cubic_ * by / radius_px_;
}

std::optional<Eigen::Vector2d> UndistortedPatch::to_pixel(const Eigen::Vector2d& plane) const {
  if (camera_ == nullptr) return plane;
  const Eigen::Vector3d local(plane.x() / scale_, plane.y() / scale_, 1.0);
  return camera_->project(patch_from_camera_.transpose() * local);
}

}  // namespace lvcalib
