// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include "simulation/disturbances/effect_plan.h"
#include "target/target.h"

namespace lvcalib::simulation {

/// How the printed board departs from its drawing. Positions in the board frame.
///
/// Bow: the elastic line of an evenly loaded strip held at both edges, (1 − ξ²)(5 − ξ²)/5 with ξ
/// from −1 to 1, along x and (less) along y, plus a twist ξη. Bump: Gaussian, 60 mm sigma.
/// Print scale, anisotropy and shear: about the board's centre, the outline keeps its size.
class BoardDisturbance {
 public:
  BoardDisturbance() = default;
  BoardDisturbance(EffectPlan& plan, const BoardOutline& outline);

  [[nodiscard]] bool is_flat() const {
    return bow_x_m_ == 0.0 && bow_y_m_ == 0.0 && twist_m_ == 0.0 && bump_m_ == 0.0;
  }
  /// Height of the board's face over its plane, towards the viewer.
  [[nodiscard]] double height_m(double x_m, double y_m) const;
  /// How the height grows along x and y.
  [[nodiscard]] Eigen::Vector2d slope(double x_m, double y_m) const;

  [[nodiscard]] bool moves_print() const { return moves_print_; }
  /// Where on the drawing the print at a board point comes from.
  [[nodiscard]] Eigen::Vector2d on_drawing(const Eigen::Vector2d& point_m) const {
    return center_m_ + drawing_from_board_ * (point_m - center_m_);
  }

  /// How far black reaches beyond its drawn edge.
  [[nodiscard]] double ink_gain_m() const { return ink_gain_m_; }

 private:
  Eigen::Vector2d center_m_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d half_m_ = Eigen::Vector2d::Ones();
  double bow_x_m_ = 0.0;
  double bow_y_m_ = 0.0;
  double twist_m_ = 0.0;
  double bump_m_ = 0.0;
  Eigen::Vector2d bump_center_m_ = Eigen::Vector2d::Zero();
  bool moves_print_ = false;
  Eigen::Matrix2d drawing_from_board_ = Eigen::Matrix2d::Identity();
  double ink_gain_m_ = 0.0;
};

}  // namespace lvcalib::simulation
