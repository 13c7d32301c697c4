// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/disturbances/camera.h"

#include <cmath>
#include <numbers>

namespace lvcalib::simulation {
namespace {

Eigen::Vector2d random_direction(Random& random) {
  const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

CameraDisturbance::CameraDisturbance(EffectPlan& plan, const Camera& nominal)
    : camera_(nominal),
      corner_bias_px_(plan.si("corner_bias")),
      radial_px_(plan.si("distortion_residual")),
      corner_px_(0.5 * std::hypot(nominal.width_px, nominal.height_px)),
      shutter_px_(plan.si("rolling_shutter")) {
  const double share = plan.si("intrinsics_error");
  Random intrinsics = plan.random("intrinsics_error");
  const Eigen::Vector2d shift_px = share * nominal.fx * random_direction(intrinsics);
  camera_.fx *= 1.0 + share;
  camera_.fy *= 1.0 + share;
  camera_.cx += shift_px.x();
  camera_.cy += shift_px.y();
  plan.note("intrinsics_error", "principal_point_px", {shift_px.x(), shift_px.y()});

  Random lens = plan.random("distortion_residual");
  decentring_px_ = 0.3 * radial_px_ * random_direction(lens);
  plan.note("distortion_residual", "decentring_px", {decentring_px_.x(), decentring_px_.y()});

  Random flaw = plan.random("x_lens_flaw");
  flaw_center_px_ = {nominal.width_px * flaw.uniform(0.3, 0.7),
                     nominal.height_px * flaw.uniform(0.3, 0.7)};
  flaw_sigma_px_ = 0.06 * nominal.width_px;
  flaw_px_ = plan.si("x_lens_flaw") * random_direction(flaw);
  plan.note("x_lens_flaw", "center_px", {flaw_center_px_.x(), flaw_center_px_.y()});
  plan.note("x_lens_flaw", "displacement_px", {flaw_px_.x(), flaw_px_.y()});
  plan.note("x_lens_flaw", "sigma_px", flaw_sigma_px_);

  bends_rays_ = share != 0.0 || radial_px_ != 0.0 || !flaw_px_.isZero(0.0) || shutter_px_ != 0.0;
  reach_px_ = std::abs(share) * (nominal.width_px + nominal.fx) + 2.0 * std::abs(radial_px_) +
              flaw_px_.norm() + 2.0 * std::abs(shutter_px_) + std::abs(corner_bias_px_);
}

Eigen::Vector2d CameraDisturbance::displacement_px(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d from_center =
      (pixel - Eigen::Vector2d(camera_.cx, camera_.cy)) / corner_px_;
  const double square = from_center.squaredNorm();
  Eigen::Vector2d out = radial_px_ * square * (0.8 + 0.2 * square) * from_center;
  out += (square * decentring_px_ + 2.0 * decentring_px_.dot(from_center) * from_center) / 3.0;
  const double from_flaw = (pixel - flaw_center_px_).squaredNorm();
  out += std::exp(-0.5 * from_flaw / (flaw_sigma_px_ * flaw_sigma_px_)) * flaw_px_;
  return out;
}

std::optional<Eigen::Vector3d> CameraDisturbance::unproject(const Eigen::Vector2d& pixel) const {
  // The displacement varies slowly: each round gains two digits at least.
  Eigen::Vector2d undisplaced = pixel;
  for (int i = 0; i < 5; ++i) undisplaced = pixel - displacement_px(undisplaced);
  auto ray = camera_.unproject(undisplaced);
  if (!ray || shutter_px_ == 0.0) return ray;
  const double turn = shutter_px_ / camera_.fx * pixel.y() / camera_.height_px;
  const double c = std::cos(turn);
  const double s = std::sin(turn);
  return Eigen::Vector3d(c * ray->x() - s * ray->z(), ray->y(), s * ray->x() + c * ray->z());
}

}  // namespace lvcalib::simulation
