// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/disturbances/board.h"

#include <Eigen/LU>

namespace lvcalib::simulation {
namespace {

constexpr double kBumpSigma = 0.06;

// Elastic line of an evenly loaded strip and its derivative.
double sag(double t) {
  return (1.0 - t * t) * (5.0 - t * t) / 5.0;
}
double sag_slope(double t) {
  return t * (4.0 * t * t - 12.0) / 5.0;
}

}  // namespace

BoardDisturbance::BoardDisturbance(EffectPlan& plan, const BoardOutline& outline)
    : center_m_(outline.center_m()),
      half_m_(0.5 * outline.size_m()),
      bow_x_m_(plan.si("board_bow")),
      bump_m_(plan.si("x_board_bump")),
      ink_gain_m_(plan.si("ink_gain")) {
  Random bow = plan.random("board_bow");
  bow_y_m_ = bow_x_m_ * bow.uniform(-0.3, 0.3);
  twist_m_ = bow_x_m_ * bow.uniform(-0.3, 0.3);
  plan.note("board_bow", "bow_y_mm", 1e3 * bow_y_m_);
  plan.note("board_bow", "twist_mm", 1e3 * twist_m_);

  Random bump = plan.random("x_board_bump");
  for (int axis = 0; axis < 2; ++axis) {
    bump_center_m_[axis] = center_m_[axis] + half_m_[axis] * bump.uniform(-0.6, 0.6);
  }
  plan.note("x_board_bump", "center_m", {bump_center_m_.x(), bump_center_m_.y()});
  plan.note("x_board_bump", "sigma_mm", 1e3 * kBumpSigma);

  const double scale = plan.si("print_scale");
  Random print = plan.random("print_scale");
  const double anisotropy = scale * print.uniform(-0.2, 0.2);
  const double shear = scale * print.uniform(-0.2, 0.2);
  plan.note("print_scale", "anisotropy_ppm", 1e6 * anisotropy);
  plan.note("print_scale", "shear_ppm", 1e6 * shear);
  moves_print_ = scale != 0.0;
  Eigen::Matrix2d board_from_drawing;
  board_from_drawing << 1.0 + scale + 0.5 * anisotropy, shear, 0.0, 1.0 + scale - 0.5 * anisotropy;
  if (moves_print_) drawing_from_board_ = board_from_drawing.inverse();
}

double BoardDisturbance::height_m(double x_m, double y_m) const {
  const double u = (x_m - center_m_.x()) / half_m_.x();
  const double v = (y_m - center_m_.y()) / half_m_.y();
  double height = bow_x_m_ * sag(u) + bow_y_m_ * sag(v) + twist_m_ * u * v;
  if (bump_m_ != 0.0) {
    const double square = (Eigen::Vector2d(x_m, y_m) - bump_center_m_).squaredNorm();
    height += bump_m_ * std::exp(-0.5 * square / (kBumpSigma * kBumpSigma));
  }
  return height;
}

Eigen::Vector2d BoardDisturbance::slope(double x_m, double y_m) const {
  const double u = (x_m - center_m_.x()) / half_m_.x();
  const double v = (y_m - center_m_.y()) / half_m_.y();
  Eigen::Vector2d slope((bow_x_m_ * sag_slope(u) + twist_m_ * v) / half_m_.x(),
                        (bow_y_m_ * sag_slope(v) + twist_m_ * u) / half_m_.y());
  if (bump_m_ != 0.0) {
    const Eigen::Vector2d from_bump = Eigen::Vector2d(x_m, y_m) - bump_center_m_;
    const double variance = kBumpSigma * kBumpSigma;
    slope -= bump_m_ * std::exp(-0.5 * from_bump.squaredNorm() / variance) / variance * from_bump;
  }
  return slope;
}

}  // namespace lvcalib::simulation
