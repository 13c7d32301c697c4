// SPDX-License-Identifier: BSD-3-Clause
#include "camera/camera.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/LU>

#include "camera/radial_profile.h"

namespace lvcalib {
namespace {

using Matrix2x3 = Eigen::Matrix<double, 2, 3>;
using Matrix2x8 = Eigen::Matrix<double, 2, 8>;

// Accuracy of unproject() in normalised coordinates: 1e-13 times a focal length of 1000 px is the
// promised 1e-10 px. Beyond the unit circle it is relative, as rounding is.
constexpr double kInverseTolerance = 1e-13;
constexpr double kAcceptedResidual = 1e-12;

struct Distorted {
  Eigen::Vector2d point;
  Eigen::Matrix2d by_point;
};

// Brown–Conrady distortion in normalised coordinates p = (x/z, y/z):
// p' = p·N/D + (2 p1 xy + p2 (s + 2x²), p1 (s + 2y²) + 2 p2 xy), s = x² + y².
Distorted distort(const RadialProfile::Ratio& radial, double p1, double p2,
                  const Eigen::Vector2d& p) {
  const double x = p.x();
  const double y = p.y();
  const double s = p.squaredNorm();
  Distorted out;
  out.point = radial.value * p + Eigen::Vector2d(2 * p1 * x * y + p2 * (s + 2 * x * x),
                                                 p1 * (s + 2 * y * y) + 2 * p2 * x * y);
  out.by_point =
      radial.value * Eigen::Matrix2d::Identity() + 2.0 * radial.derivative * p * p.transpose();
  const double cross = 2 * p1 * x + 2 * p2 * y;
  out.by_point(0, 0) += 2 * p1 * y + 6 * p2 * x;
  out.by_point(0, 1) += cross;
  out.by_point(1, 0) += cross;
  out.by_point(1, 1) += 6 * p1 * y + 2 * p2 * x;
  return out;
}

// Derivatives of distort() by k1 k2 p1 p2 k3 k4 k5 k6.
Matrix2x8 distort_by_coefficients(const RadialProfile::Ratio& radial, const Eigen::Vector2d& p) {
  const double s = p.squaredNorm();
  const double xy = 2 * p.x() * p.y();
  Matrix2x8 out;
  out.col(0) = p * s / radial.denominator;
  out.col(1) = out.col(0) * s;
  out.col(2) << xy, s + 2 * p.y() * p.y();
  out.col(3) << s + 2 * p.x() * p.x(), xy;
  out.col(4) = out.col(1) * s;
  out.col(5) = -radial.value * out.col(0);
  out.col(6) = out.col(5) * s;
  out.col(7) = out.col(6) * s;
  return out;
}

// A point's image in normalised distorted coordinates with derivatives.
struct NormalizedImage {
  Eigen::Vector2d point;
  Matrix2x3 by_point;
  Matrix2x8 by_coefficients;
};

bool image_perspective(const Camera& camera, const Eigen::Vector3d& point, bool coefficients,
                       NormalizedImage& out) {
  if (!(point.z() > 0.0)) return false;
  const Eigen::Vector2d p = point.head<2>() / point.z();
  const RadialProfile profile(camera);
  if (!profile.images(p.norm())) return false;
  const RadialProfile::Ratio radial = profile.ratio(p.squaredNorm());
  const Distorted d = distort(radial, camera.distortion[2], camera.distortion[3], p);
  // Strong decentring can turn the image over where the radial part alone does not.
  if (!(d.by_point.determinant() > 0.0)) return false;
  out.point = d.point;
  out.by_point.leftCols<2>() = d.by_point / point.z();
  out.by_point.col(2) = -d.by_point * p / point.z();
  if (coefficients) {
    out.by_coefficients = distort_by_coefficients(radial, p);
    if (camera.model == DistortionModel::kPlumbBob) out.by_coefficients.rightCols<3>().setZero();
  }
  return true;
}

// Kannala–Brandt: p' = θ_d(θ)/r·(x, y), r = |(x, y)|, θ = atan2(r, z).
bool image_equidistant(const Camera& camera, const Eigen::Vector3d& point, bool coefficients,
                       NormalizedImage& out) {
  const Eigen::Vector2d xy = point.head<2>();
  const double z = point.z();
  const double r = xy.norm();
  const double distance_sq = point.squaredNorm();
  if (!(distance_sq > 0.0) || (r == 0.0 && !(z > 0.0))) return false;
  const double theta = std::atan2(r, z);
  const RadialProfile profile(camera);
  if (!profile.images(theta)) return false;
  const double s = theta * theta;
  const RadialProfile::Ratio radial = profile.ratio(s);
  const double slope = radial.value + 2 * s * radial.derivative;  // dθ_d/dθ
  // On the axis θ/r → 1/z; bend = (d(θ_d/r)/dr)/r by its series, where the formula cancels.
  const bool on_axis = z > 0.0 && r < 1e-4 * z;
  const double angle_per_r = on_axis ? (1.0 - r * r / (3.0 * z * z)) / z : theta / r;
  const double scale = radial.value * angle_per_r;
  const double bend = on_axis ? 2.0 * (camera.distortion[0] - 1.0 / 3.0) / (z * z * z)
                              : (slope * z / distance_sq - scale) / (r * r);
  out.point = scale * xy;
  out.by_point.leftCols<2>() = scale * Eigen::Matrix2d::Identity() + bend * xy * xy.transpose();
  out.by_point.col(2) = -slope / distance_sq * xy;
  if (coefficients) {
    out.by_coefficients.setZero();
    Eigen::Vector2d column = angle_per_r * xy;
    for (int i = 0; i < 4; ++i) {
      column *= s;
      out.by_coefficients.col(i) = column;
    }
  }
  return true;
}

// Newton's method with step halving; p starts near the solution.
bool invert_distortion(const Camera& camera, const Eigen::Vector2d& target, Eigen::Vector2d& p) {
  const RadialProfile profile(camera);
  const double p1 = camera.distortion[2];
  const double p2 = camera.distortion[3];
  const auto at = [&](const Eigen::Vector2d& q) {
    return distort(profile.ratio(q.squaredNorm()), p1, p2, q);
  };
  const double unit = std::max(1.0, target.norm());
  Distorted now = at(p);
  Eigen::Vector2d residual = now.point - target;
  for (int i = 0; i < 50 && residual.norm() > 1e-2 * kInverseTolerance * unit; ++i) {
    Eigen::Vector2d step = now.by_point.inverse() * residual;
    if (!step.allFinite()) break;
    bool better = false;
    for (int halving = 0; halving < 30 && !better; ++halving, step *= 0.5) {
      const Eigen::Vector2d q = p - step;
      if (!profile.images(q.norm())) continue;
      const Distorted next = at(q);
      const Eigen::Vector2d next_residual = next.point - target;
      if (!(next_residual.norm() < residual.norm())) continue;
      p = q;
      now = next;
      residual = next_residual;
      better = true;
    }
    if (!better) break;
  }
  return residual.norm() <= kAcceptedResidual * unit && now.by_point.determinant() > 0.0;
}

std::optional<Eigen::Vector3d> ray_equidistant(const Camera& camera, const Eigen::Vector2d& p) {
  const double distorted = p.norm();
  if (distorted == 0.0) return Eigen::Vector3d::UnitZ();
  const RadialProfile profile(camera);
  const double theta = profile.undistorted(distorted);
  const double residual = profile.distorted(theta) - distorted;
  if (!(std::abs(residual) <= kAcceptedResidual * std::max(1.0, distorted))) return std::nullopt;
  const Eigen::Vector2d side = std::sin(theta) / distorted * p;
  return Eigen::Vector3d(side.x(), side.y(), std::cos(theta));
}

std::optional<Eigen::Vector3d> ray_perspective(const Camera& camera,
                                               const Eigen::Vector2d& target) {
  const double distorted = target.norm();
  const double radius = RadialProfile(camera).undistorted(distorted);
  Eigen::Vector2d p = distorted > 0.0 ? Eigen::Vector2d(radius / distorted * target) : target;
  const bool decentred = camera.distortion[2] != 0.0 || camera.distortion[3] != 0.0;
  // At the very edge of the field the derivative vanishes; Newton starts a little inside.
  if (decentred && RadialProfile(camera).distorted(radius) < distorted * (1.0 - 1e-9)) p *= 0.99;
  if (!invert_distortion(camera, target, p)) return std::nullopt;
  return Eigen::Vector3d(p.x(), p.y(), 1.0).normalized();
}

}  // namespace

int Camera::distortion_count() const {
  switch (model) {
    case DistortionModel::kPlumbBob:
      return 5;
    case DistortionModel::kRationalPolynomial:
      return 8;
    case DistortionModel::kEquidistant:
      break;
  }
  return 4;
}

std::optional<Eigen::Vector2d> Camera::project(const Eigen::Vector3d& point_m,
                                               Eigen::Matrix<double, 2, 3>* by_point,
                                               Eigen::Matrix<double, 2, 12>* by_intrinsics) const {
  NormalizedImage image;
  const bool coefficients = by_intrinsics != nullptr;
  const bool imaged = model == DistortionModel::kEquidistant
                          ? image_equidistant(*this, point_m, coefficients, image)
                          : image_perspective(*this, point_m, coefficients, image);
  if (!imaged) return std::nullopt;
  const Eigen::Vector2d focal(fx, fy);
  const Eigen::Vector2d pixel = focal.cwiseProduct(image.point) + Eigen::Vector2d(cx, cy);
  if (!pixel.allFinite()) return std::nullopt;
  if (by_point != nullptr) *by_point = focal.asDiagonal() * image.by_point;
  if (by_intrinsics != nullptr) {
    by_intrinsics->setZero();
    (*by_intrinsics)(0, 0) = image.point.x();
    (*by_intrinsics)(1, 1) = image.point.y();
    (*by_intrinsics)(0, 2) = 1.0;
    (*by_intrinsics)(1, 3) = 1.0;
    by_intrinsics->rightCols<8>() = focal.asDiagonal() * image.by_coefficients;
  }
  return pixel;
}

std::optional<Eigen::Vector3d> Camera::unproject(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d p((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  if (!p.allFinite()) return std::nullopt;
  return model == DistortionModel::kEquidistant ? ray_equidistant(*this, p)
                                                : ray_perspective(*this, p);
}

Status check(const Camera& c) {
  const auto bad = [](Message message, Message hint = {}, const char* field = "") -> Status {
    Error error = Error::input(std::move(message), {}, std::move(hint));
    error.field = field;
    return error;
  };
  if (c.width_px < 1 || c.height_px < 1) {
    return bad(Message("the image size must be positive, found %1 × %2", c.width_px, c.height_px));
  }
  if (!std::isfinite(c.cx) || !std::isfinite(c.cy) || !c.distortion.allFinite()) {
    return bad(Message("the intrinsics must be finite numbers"));
  }
  // From fisheye lenses that see all round to telescopes: f / image side well inside 1/50 … 1000.
  const double side = std::max(c.width_px, c.height_px);
  for (const auto& [f, field] : {std::pair(c.fx, "fx"), std::pair(c.fy, "fy")}) {
    if (!(f >= side / 50.0 && f <= 1000.0 * side)) {
      return bad(Message("a focal length of %1 px is not plausible for an image %2 px long",
                         std::to_string(f), static_cast<int>(side)),
                 Message("focal lengths are given in pixels"), field);
    }
  }
  // A cropped image may have lost its principal point, but not by more than its own size.
  if (c.cx < -c.width_px || c.cx > 2.0 * c.width_px || c.cy < -c.height_px ||
      c.cy > 2.0 * c.height_px) {
    return bad(Message("the principal point (%1, %2) px lies far outside the image of %3 × %4 px",
                       std::to_string(c.cx), std::to_string(c.cy), c.width_px, c.height_px),
               {}, "cx");
  }
  return Done{};
}

}  // namespace lvcalib
