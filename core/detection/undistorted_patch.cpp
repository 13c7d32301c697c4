// SPDX-License-Identifier: BSD-3-Clause
#include "detection/undistorted_patch.h"

#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/QR>

#include "base/rigid3.h"

namespace lvcalib {
namespace {

constexpr int kDegree = 5;
constexpr int kTerms = 21;
using Basis = Eigen::Matrix<double, kTerms, 1>;

// x^(d−j) y^j for all degrees d up to five.
Basis basis(double x, double y) {
  double px[kDegree + 1] = {1.0};
  double py[kDegree + 1] = {1.0};
  for (int i = 1; i <= kDegree; ++i) {
    px[i] = px[i - 1] * x;
    py[i] = py[i - 1] * y;
  }
  Basis out;
  int term = 0;
  for (int d = 0; d <= kDegree; ++d) {
    for (int j = 0; j <= d; ++j) out[term++] = px[d - j] * py[j];
  }
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
  patch_from_camera_ = rotation_between(*center, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  scale_ = 0.5 * (camera.fx + camera.fy);
  constexpr int kSteps = 7;
  Eigen::Matrix<double, kSteps * kSteps, kTerms> design;
  Eigen::Matrix<double, kSteps * kSteps, 2> values;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    // Denser towards the rim, as Chebyshev's nodes, against overshoot.
    const int column = i % kSteps;
    const int row = i / kSteps;
    const double x = std::cos((column + 0.5) * M_PI / kSteps);
    const double y = std::cos((row + 0.5) * M_PI / kSteps);
    const auto plane = exact(center_px_ + radius_px_ * Eigen::Vector2d(x, y));
    if (!plane) return false;
    design.row(i) = basis(x, y).transpose();
    values.row(i) = plane->transpose();
  }
  quintic_ = design.householderQr().solve(values).transpose();
  return quintic_.allFinite();
}

std::optional<UndistortedPatch> UndistortedPatch::create(const Camera* camera,
                                                         const Eigen::Vector2d& center_px,
                                                         double radius_px) {
  UndistortedPatch patch;
  patch.camera_ = camera;
  patch.center_px_ = center_px;
  patch.radius_px_ = radius_px;
  if (camera == nullptr) {
    patch.quintic_.col(0) = center_px;
    patch.quintic_(0, 1) = patch.quintic_(1, 2) = radius_px;
    return patch;
  }
  if (!patch.fit(*camera)) return std::nullopt;
  return patch;
}

Eigen::Vector2d UndistortedPatch::to_plane(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d p = (pixel - center_px_) / radius_px_;
  return quintic_ * basis(p.x(), p.y());
}

Eigen::Matrix2d UndistortedPatch::plane_by_pixel(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d p = (pixel - center_px_) / radius_px_;
  // Central differences: exact enough for a polynomial on the unit square, and called rarely.
  constexpr double kStep = 1e-4;
  Eigen::Matrix2d out;
  out.col(0) = quintic_ * (basis(p.x() + kStep, p.y()) - basis(p.x() - kStep, p.y()));
  out.col(1) = quintic_ * (basis(p.x(), p.y() + kStep) - basis(p.x(), p.y() - kStep));
  return out / (2.0 * kStep * radius_px_);
}

std::optional<Eigen::Vector2d> UndistortedPatch::to_pixel(const Eigen::Vector2d& plane) const {
  if (camera_ == nullptr) return plane;
  const Eigen::Vector3d local(plane.x() / scale_, plane.y() / scale_, 1.0);
  return camera_->project(patch_from_camera_.transpose() * local);
}

}  // namespace lvcalib
